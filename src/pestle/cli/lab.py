"""pestle lab: finite elements of one sphere between flats."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from pestle.cli.lab_compare import compare
from pestle.cli.lab_confined import confined
from pestle.cli.lab_law import law
from pestle.cli.lab_laws import laws
from pestle.cli.lab_options import (
    ProgressLines,
    SecondOpinion,
    depths_of,
    mesh_of,
    numbers_of,
    second_opinion,
    show_second_opinion,
)
from pestle.cli.lab_study import study
from pestle.cli.options import AsJson
from pestle.errors import InputError

if TYPE_CHECKING:
    from pestle.lab.material import Hardening
    from pestle.lab.press import Result

lab = typer.Typer(
    help="Finite elements: one elastic-plastic sphere between rigid flats.",
    no_args_is_help=True,
)


@lab.command()
def sphere(
    modulus_ratio: Annotated[
        float, typer.Option(help="Young's modulus over yield stress, E/Y.")
    ],
    poisson: Annotated[float, typer.Option(help="Poisson ratio.")] = 0.3,
    to: Annotated[
        float | None,
        typer.Option(
            help="Largest depth of the flat, in radii; by default the last of "
            "--unload, else 0.5.",
            show_default=False,
        ),
    ] = None,
    unload: Annotated[
        str,
        typer.Option(metavar="D1,D2,...", help="Depths to unload from, in radii."),
    ] = "",
    hardening_exponent: Annotated[
        float,
        typer.Option(help="n of the flow stress Y (1 + strain/reference)^n."),
    ] = 0.0,
    reference_strain: Annotated[
        float | None,
        typer.Option(
            help="Reference strain of that law, by default Y/E.", show_default=False
        ),
    ] = None,
    hardening_table: Annotated[
        str,
        typer.Option(
            metavar="E1:S1,...",
            help="Plastic strain and flow stress over Y, instead of that law: "
            "0:1,0.1:1.4.",
        ),
    ] = "",
    work_of_adhesion: Annotated[
        float | None,
        typer.Option(
            help="W of sphere and flat, over E R: adds the pull-off of the relaxed "
            "spheres.",
            show_default=False,
        ),
    ] = None,
    mesh: Annotated[
        str,
        typer.Option(
            help="coarse (1280 elements), medium (2880) or fine (6644), or one of them "
            "and a factor on its edges: coarse*0.8."
        ),
    ] = "coarse",
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Folder for tables, profiles and frames (VTU).",
            show_default=False,
        ),
    ] = None,
    frames: Annotated[
        bool, typer.Option("--frames", help="A frame for every step, with --out.")
    ] = False,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace an earlier run in DIR.")
    ] = False,
    ask_calculix: SecondOpinion = False,
    as_json: AsJson = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress.")] = False,
) -> None:
    """Press one sphere and unload it from several depths.

    The numbers are in radii, E R^2 and yield stresses. One loading serves all
    unloadings.
    """
    from pestle.lab.material import Material
    from pestle.lab.press import press

    depths = depths_of(unload)
    end = to if to is not None else max(depths, default=0.5)
    hardening = _hardening(hardening_exponent, reference_strain, hardening_table)
    material = Material(modulus_ratio, poisson, hardening)
    fineness = mesh_of(mesh)
    if out is not None:
        _prepare(out, overwrite=overwrite)
    elif frames:
        raise InputError(
            "frames-without-folder",
            "--frames has no folder to write to",
            "--frames",
            "add --out DIR",
        )
    report = None if quiet else ProgressLines()
    each = None
    if out is not None and frames:
        from pestle.lab.output import Frames

        each = Frames(out)
    result = press(material, end, depths, mesh=fineness, progress=report, each=each)
    numbers = result.to_dict(work_of_adhesion)
    if out is not None:
        from pestle.lab.output import write

        write(result, numbers, out)
    if ask_calculix and result.loading:
        from pestle.lab.second_opinion import of_sphere

        numbers["second_opinion"] = second_opinion(lambda: of_sphere(result))
    _show(result, numbers, as_json=as_json)
    if result.stopped is not None:
        raise result.stopped


def _show(result: "Result", numbers: dict[str, Any], *, as_json: bool) -> None:
    import json

    from pestle.cli.printing import plain, print_table

    if as_json:
        typer.echo(json.dumps(plain(numbers)))
        return
    if result.loading:
        last = numbers["loading"][-1]
        typer.echo(
            f"depth {last['d_R']:.4g} R: force {last['F_ER2']:.5g} E R^2, mean "
            f"pressure {last['pbar_Y']:.4g} Y, contact radius "
            f"{last['A_piR2'] ** 0.5:.4g} R (between {last['r_in']:.4g} and "
            f"{last['r_out']:.4g})"
        )
        typer.echo(
            f"work {last['work_ER3']:.5g} E R^3 = elastic {last['elastic_ER3']:.5g} + "
            f"plastic {last['plastic_ER3']:.5g}; {len(result.loading)} steps, "
            f"{result.cpu_time:.1f} s of processor time"
        )
    keys = ["dmax_R", "d0_R", "rho", "alpha", "Fmax_ER2", "R2"]
    if numbers["unloading"] and "pull_off_ER2" in numbers["unloading"][0]:
        keys.append("pull_off_ER2")
    rows = [[f"{row[key]:.5g}" for key in keys] for row in numbers["unloading"]]
    if rows:
        typer.echo("")
        print_table([keys, *rows])
    show_second_opinion(numbers.get("second_opinion", {}))


def _hardening(exponent: float, reference: float | None, table: str) -> "Hardening":
    from pestle.lab.material import Hardening

    rows = None
    if table:
        pairs = [numbers_of(p, "--hardening-table", ":") for p in table.split(",")]
        if any(len(pair) != 2 for pair in pairs):
            raise InputError(
                "not-a-list-of-pairs",
                f"{table!r} is not a list of strain:stress",
                "--hardening-table",
                "such as 0:1,0.1:1.4,0.5:1.9",
            )
        rows = tuple((pair[0], pair[1]) for pair in pairs)
    return Hardening(exponent, reference, rows)


def _prepare(folder: Path, *, overwrite: bool) -> None:
    """Make the folder; refuse to mix two experiments in it."""
    from pestle.lab.output import WRITTEN

    if folder.exists() and not folder.is_dir():
        raise InputError("not-a-folder", f"{folder} is a file", "--out")
    present = [name for name in WRITTEN if (folder / name).exists()]
    if present and not overwrite:
        raise InputError(
            "folder-in-use",
            f"{folder} holds an earlier experiment",
            "--out",
            "--overwrite replaces it, or name another --out",
        )
    for name in present:
        (folder / name).unlink()
    for frame in (folder / "frames").glob("*.vtu"):
        frame.unlink()
    folder.mkdir(parents=True, exist_ok=True)


lab.command()(study)
lab.command()(compare)
lab.command()(confined)
lab.command()(law)
lab.command()(laws)
