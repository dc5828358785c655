"""pestle lab law: constants of published laws for one's own material."""

from pathlib import Path
from typing import Annotated

import typer

from pestle.cli.options import AsJson


def law(
    modulus_ratio: Annotated[
        float, typer.Option(help="Young's modulus over yield stress, E/Y.")
    ],
    poisson: Annotated[float, typer.Option(help="Poisson ratio.")] = 0.3,
    to: Annotated[
        float, typer.Option(help="Largest depth of the flat, in radii.")
    ] = 0.5,
    mesh: Annotated[
        str, typer.Option(help="coarse, medium or fine, and a factor: coarse*0.8.")
    ] = "coarse",
    out: Annotated[
        Path, typer.Option(metavar="DIR", help="Folder for the parameter sets.")
    ] = Path("laws"),
    name: Annotated[
        str, typer.Option(help="First part of the names of the sets.")
    ] = "own",
    as_json: AsJson = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress.")] = False,
) -> None:
    """Fit Zunker's hardening curve and Shahin's law to a material of your own.

    Presses one sphere and writes two parameter sets, which stand for a law in `pestle
    lab compare NAME-zunker2024.toml`. For unloading there is `pestle lab study
    edmans2020`.
    """
    from pestle.cli.lab_options import ProgressLines, mesh_of
    from pestle.cli.lab_study import show_fit
    from pestle.cli.printing import print_json
    from pestle.lab import fits
    from pestle.lab.material import Material
    from pestle.lab.own_law import fit_shahin
    from pestle.lab.press import press

    report = None if quiet else ProgressLines()
    material = Material(modulus_ratio, poisson)
    result = press(material, to, mesh=mesh_of(mesh), progress=report)
    if result.stopped is not None:
        raise result.stopped
    found = [fits.fit("zunker2024", [result.to_dict()]), fit_shahin(result)]
    out.mkdir(parents=True, exist_ok=True)
    paths = [out / f"{name}-{one.study}.toml" for one in found]
    for one, path in zip(found, paths, strict=True):
        fits.save(one, path.stem, path)
    if as_json:
        print_json({"fits": found, "files": paths})
        return
    for one, path in zip(found, paths, strict=True):
        show_fit(one, path)
        typer.echo("")
