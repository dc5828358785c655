"""Gaussian processes that stand for the runs: one for each number that is compared."""

import warnings
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Surrogate:
    """Processes of scikit-learn, each over the shares of the parameters.

    Parameters
    ----------
    models : list
        A fitted process for each output.
    mean, scale : ndarray
        Outputs are taken relative to these.
    """

    models: list[Any]
    mean: Array
    scale: Array

    @cached_property
    def _stacked(self) -> tuple[Array, ...]:
        """Constants of all processes in one array each, for `predict`."""
        kernels = [model.kernel_ for model in self.models]
        factors = [np.linalg.inv(model.L_).T for model in self.models]
        return (
            np.stack(
                [k.k1.k2.length_scale * np.ones(self._runs.shape[1]) for k in kernels]
            ),
            np.array([k.k1.k1.constant_value for k in kernels]),
            np.array([k.k2.noise_level for k in kernels]),
            np.stack([model.alpha_ for model in self.models]),
            np.stack(factors),
        )

    @property
    def _runs(self) -> Array:
        return np.asarray(self.models[0].X_train_)

    def predict(self, shares: Array) -> tuple[Array, Array]:
        """Mean and standard deviation of each output, a row a point.

        What `GaussianProcessRegressor.predict` gives process by process, for all of
        them at once: a chain asks some thousand times for a few points.
        """
        length, constant, noise, weight, factor = self._stacked
        off = (shares[None, :, None] - self._runs[None, None]) / length[:, None, None]
        r = np.sqrt(5.0 * np.sum(off**2, axis=-1))
        near = constant[:, None, None] * (1.0 + r + r**2 / 3.0) * np.exp(-r)
        mean = (near @ weight[:, :, None])[:, :, 0].T
        known = np.sum((near @ factor) ** 2, axis=-1)
        error = np.sqrt(np.maximum((constant + noise)[:, None] - known, 0.0)).T
        return self.mean + self.scale * mean, self.scale * error

    def unknown(self, shares: Array) -> Array:
        """Standard deviation that more runs can take away: without their noise."""
        _, error = self.predict(shares)
        noise = [model.kernel_.k2.noise_level for model in self.models]
        left = (error / self.scale) ** 2 - np.array(noise)
        return np.asarray(self.scale * np.sqrt(np.maximum(left, 0.0)))


def train(shares: Array, outputs: Array, seed: int) -> Surrogate:
    """Fit a process to each column of the outputs.

    Matern kernel of 5/2, a length for each parameter, and white noise: runs with
    another packing do not repeat exactly.
    """
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import (
        ConstantKernel,
        Matern,
        WhiteKernel,
    )

    mean = outputs.mean(axis=0)
    scale = np.maximum(outputs.std(axis=0), 1e-12 * np.abs(mean) + 1e-300)
    models = []
    for column in ((outputs - mean) / scale).T:
        kernel = ConstantKernel(1.0, (1e-2, 1e3)) * Matern(
            np.ones(shares.shape[1]), (0.1, 30.0), nu=2.5
        ) + WhiteKernel(1e-3, (1e-7, 0.3))
        model = GaussianProcessRegressor(
            kernel, n_restarts_optimizer=2, random_state=seed
        )
        with warnings.catch_warnings():  # a length at its bound: no influence
            warnings.simplefilter("ignore", ConvergenceWarning)
            model.fit(shares, column)
        models.append(model)
    return Surrogate(models, mean, scale)


def left_out(shares: Array, outputs: Array, surrogate: Surrogate) -> Array:
    """Error of each output at each run, predicted from all others, over its scale.

    Closed form for a process whose kernel stays as it is: K^-1 y over the diagonal of
    K^-1 (Rasmussen & Williams 2006, eq. 5.12).
    """
    errors = []
    scaled = (outputs - surrogate.mean) / surrogate.scale
    for model, column in zip(surrogate.models, scaled.T, strict=True):
        inverse = np.linalg.inv(model.kernel_(shares) + 1e-10 * np.eye(len(shares)))
        errors.append(inverse @ column / np.diag(inverse))
    return np.column_stack(errors)


def indices(surrogate: Surrogate, names: tuple[str, ...], seed: int) -> dict[str, Any]:
    """First and total Sobol indices of each output (SALib), by the surrogate."""
    from SALib.analyze import sobol as analyze
    from SALib.sample import sobol

    problem = {
        "num_vars": len(names),
        "names": list(names),
        "bounds": [[0.0, 1.0]] * len(names),
    }
    points = sobol.sample(problem, 256, calc_second_order=False, seed=seed)
    outputs, _ = surrogate.predict(points)
    first, total = [], []
    for column in outputs.T:
        if np.ptp(column) <= 1e-9 * np.max(np.abs(column)):
            first.append([0.0] * len(names))
            total.append([0.0] * len(names))
            continue
        found = analyze.analyze(
            problem, column, calc_second_order=False, seed=seed, print_to_console=False
        )
        first.append([float(v) for v in found["S1"]])
        total.append([float(v) for v in found["ST"]])
    return {"first": first, "total": total}
