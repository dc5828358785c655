r"""What data say of parameters: a chain of samples and what follows from it.

Parameters are sampled as shares u of their intervals, on their own scale.  The chain is
that of emcee (Foreman-Mackey et al. 2013); it ends when it is longer than fifty times
the integrated autocorrelation time of every parameter, and then the first five of these
times are dropped.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from pestle.errors import InputError, SimulationError

if TYPE_CHECKING:
    from pestle.config.calibration import Parameter

Array = NDArray[np.float64]
Density = Callable[[Array], Array]

BLOCK = 500
"""Steps between two looks at the autocorrelation [-]."""
LENGTH = 50.0
"""Length of a chain over its autocorrelation time [-]."""
MOST = 40_000
"""Longest chain [-]."""
TOLD_NOTHING = 0.7
"""Width of posterior over prior from which on the data say little [-]."""
TIED = 0.95
"""Correlation from which on two parameters are known together rather than each [-]."""
LONG = 0.5
"""Width over the prior's from which on such parameters cannot be told apart [-]."""


def require() -> None:
    """Refuse to begin without the libraries of a calibration."""
    from importlib.util import find_spec

    for name in ("emcee", "sklearn", "SALib"):
        if find_spec(name) is None:
            raise InputError(
                "missing-extra",
                f"a calibration needs {name}, which is not installed",
                hint='install it with: pip install "pestle[calibrate]"',
            )


@dataclass(frozen=True)
class Posterior:
    """Samples of the parameters.

    Parameters
    ----------
    names, units : tuple of str
        Parameters and their SI units.
    shares : ndarray
        Samples as shares of the intervals, a row a sample [-].
    values : ndarray
        Samples in SI units.
    autocorrelation : float
        Longest autocorrelation time [steps].
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    shares: Array
    values: Array
    autocorrelation: float

    @property
    def median(self) -> Array:
        """Median of each parameter."""
        return np.median(self.values, axis=0)

    def interval(self, level: float = 0.95) -> Array:
        """Credible interval of each parameter, equal tails."""
        tail = 0.5 * (1.0 - level)
        return np.quantile(self.values, [tail, 1.0 - tail], axis=0).T

    @property
    def correlation(self) -> Array:
        """Correlation of the shares."""
        return np.atleast_2d(np.corrcoef(self.shares, rowvar=False))

    @property
    def narrowing(self) -> Array:
        """Standard deviation over that of all shares being as likely [-]."""
        return np.asarray(np.std(self.shares, axis=0) * 12.0**0.5)

    @property
    def effective(self) -> int:
        """Number of samples that are independent of each other."""
        return int(len(self.shares) / self.autocorrelation)


def log_prior(parameters: "dict[str, Parameter]", shares: Array) -> Array:
    """Logarithm of the prior density over shares; -inf outside the intervals."""
    total = np.where(np.all((shares > 0.0) & (shares < 1.0), axis=1), 0.0, -np.inf)
    for column, parameter in enumerate(parameters.values()):
        if parameter.normal is not None:
            mean, deviation = parameter.normal
            value = values_at({"": parameter}, shares[:, column : column + 1])[:, 0]
            total = total - 0.5 * ((value - mean) / deviation) ** 2
            if parameter.scale == "log":  # a density over values, as one over shares
                total = total + np.log(np.maximum(value, 1e-300))
    return total


def values_at(parameters: "dict[str, Parameter]", shares: Array) -> Array:
    """Values in SI units of shares, a row each."""
    columns = []
    for column, parameter in enumerate(parameters.values()):
        low, high = parameter.ends
        u = shares[:, column]
        if parameter.scale == "log":
            columns.append(low * (high / low) ** u)
        else:
            columns.append(low + u * (high - low))
    return np.column_stack(columns)


def sample(
    parameters: "dict[str, Parameter]",
    likelihood: Density,
    start: Array,
    seed: int,
    spread: float = 0.02,
) -> Posterior:
    """Sample the posterior.

    Parameters
    ----------
    parameters : dict of Parameter
        Parameters by name.
    likelihood : callable
        Logarithm of the likelihood of many rows of shares.
    start : ndarray
        Shares to begin around [-].
    seed : int
        Seed of the chain [-].
    spread : float
        Spread of the walkers at the start [-].

    Raises
    ------
    SimulationError
        If the chain does not settle.
    """
    import emcee

    count = len(parameters)
    walkers = max(32, 4 * count)
    random = np.random.default_rng(seed)
    first = start + spread * random.standard_normal((walkers, count))
    first = np.clip(first, 1e-3, 1.0 - 1e-3)

    def density(shares: Array) -> Array:
        total = log_prior(parameters, shares)
        inside = np.isfinite(total)
        if np.any(inside):
            total[inside] += likelihood(shares[inside])
        return total

    sampler = emcee.EnsembleSampler(walkers, count, density, vectorize=True)
    sampler.random_state = np.random.RandomState(seed % 2**32).get_state()
    state = first
    while sampler.iteration < MOST:
        state = sampler.run_mcmc(state, BLOCK)
        time = float(np.max(sampler.get_autocorr_time(tol=0, quiet=True)))
        if np.isfinite(time) and sampler.iteration > LENGTH * time:
            dropped, thin = int(5.0 * time) + 1, max(int(0.5 * time), 1)
            shares = sampler.get_chain(discard=dropped, thin=thin, flat=True)
            units = tuple(p.unit or "1" for p in parameters.values())
            values = values_at(parameters, shares)
            return Posterior(
                tuple(parameters), units, shares, values, max(time / thin, 1.0)
            )
    raise SimulationError(
        "chain-not-settled",
        f"after {MOST} steps the chain still remembers its start",
        hint="narrower bounds, or fewer parameters",
    )


def warnings(found: Posterior) -> list[str]:
    """What the data cannot say, in sentences."""
    told = []
    for name, narrowing in zip(found.names, found.narrowing, strict=True):
        if narrowing > TOLD_NOTHING:
            told.append(
                f"The data say little about {name}: its interval is "
                f"{100 * narrowing:.0f} % as wide as its bounds alone make it."
            )
    for i, first in enumerate(found.names):
        for j, second in enumerate(found.names[:i]):
            r = float(found.correlation[i, j])
            if abs(r) > TIED and max(found.narrowing[i], found.narrowing[j]) > LONG:
                told.append(
                    f"{second} and {first} cannot be told apart by these data "
                    f"(correlation {r:+.2f}): {advice(first, second)}."
                )
            elif abs(r) > TIED:
                told.append(
                    f"A combination of {second} and {first} is known better than each "
                    f"of them (correlation {r:+.2f})."
                )
    low, high = np.quantile(found.shares, [0.025, 0.975], axis=0)
    for name, a, b in zip(found.names, low, high, strict=True):
        if (a < 0.005) != (b > 0.995) and b - a < TOLD_NOTHING:
            side = "lower" if a < 0.005 else "upper"
            told.append(f"{name} lies at its {side} bound: widen the bounds.")
    return told


def advice(first: str, second: str) -> str:
    """What else to measure."""
    names = f"{first} {second}"
    for word, text in (
        ("work_of_adhesion", "add a pull-off test or the strength of the tablet"),
        ("friction", "add the stress on the die wall or a shear test"),
        ("youngs_modulus", "add an unloading"),
        ("psi_b", "add points at higher density"),
    ):
        if word in names:
            return text
    return "fix one of them, or add another kind of measurement"
