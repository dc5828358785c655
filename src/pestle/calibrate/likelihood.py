r"""How likely measured data are, by a surrogate that stands for the runs.

.. math::
    \ln L = -\tfrac12 (y - \mu)^T C^{-1} (y - \mu) - \tfrac12 \ln\det C, \qquad
    C_{kl} = \sigma_k^2 \delta_{kl} + s_k R_{kl} s_l

with the measured y_k and their deviation sigma_k, and mean mu_k and deviation s_k of
the surrogate, which holds the scatter from packing to packing.  s_k is at least the
root mean square error of the runs, each predicted from all others: few runs can make a
process take scatter for shape.  A packing that is stiffer is so at all densities: R is
the correlation of these errors, shrunk as so few runs need it (Ledoit & Wolf 2004).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pestle.calibrate.runs import Measured
from pestle.calibrate.surrogate import Surrogate, left_out

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Likelihood:
    """Logarithm of the likelihood of rows of shares.

    Parameters
    ----------
    surrogate : Surrogate
        Stands for the runs.
    value, deviation : ndarray
        What was measured, and its standard deviation.
    correlation : ndarray
        Of the errors of the runs [-].
    left_out : ndarray
        Root mean square error of the runs, each predicted from all others.
    """

    surrogate: Surrogate
    value: Array
    deviation: Array
    correlation: Array
    left_out: Array

    @classmethod
    def of(
        cls,
        measured: list[Measured],
        surrogate: Surrogate,
        shares: Array,
        outputs: Array,
    ) -> "Likelihood":
        """Likelihood of measured numbers, with the errors of the runs so far."""
        from sklearn.covariance import ledoit_wolf

        errors = left_out(shares, outputs, surrogate) * surrogate.scale
        size = np.maximum(np.sqrt(np.mean(errors**2, axis=0)), 1e-300)
        shrunk, _ = ledoit_wolf(errors / size, assume_centered=True)
        own = np.sqrt(np.diag(shrunk))
        return cls(
            surrogate,
            np.array([m.value for m in measured]),
            np.array([m.deviation for m in measured]),
            shrunk / np.outer(own, own),
            size,
        )

    def predict(self, shares: Array) -> tuple[Array, Array]:
        """Mean and deviation s of each number, a row a point."""
        mean, error = self.surrogate.predict(shares)
        return mean, np.maximum(error, self.left_out)

    def __call__(self, shares: Array) -> Array:
        """Evaluate rows of shares."""
        mean, error = self.predict(shares)
        covariance = error[:, :, None] * self.correlation * error[:, None, :]
        covariance += np.diag(self.deviation**2)
        factor = np.linalg.cholesky(covariance)
        off = np.linalg.solve(factor, (self.value - mean)[:, :, None])[:, :, 0]
        size = np.log(np.diagonal(factor, axis1=1, axis2=2))
        return np.asarray(-0.5 * np.sum(off**2, axis=1) - np.sum(size, axis=1))
