"""A law draws itself: the mixin of the pair laws."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Drawn:
    """What gives a pair law its `plot`; a law of one's own may do without."""

    __slots__ = ()

    def plot(self, **options: Any) -> "Figure":
        """Draw loading and unloading; options of `pestle.bench.figure.draw_pair_law`.

        Without options: a particle of 50 um and a rigid wall, E = 5 GPa, nu = 0.3,
        Y = 20 MPa, W = 0.1 J/m^2.
        """
        from pestle.bench.figure import draw_pair_law

        return draw_pair_law(self, **options)
