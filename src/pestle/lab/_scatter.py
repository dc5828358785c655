"""Compiled loops between elements and the sparse system."""

from pestle.lab._compile import kernel


@kernel
def scatter(values, places, data):
    """Sum element numbers into the places where they belong, in a fixed order."""
    data[:] = 0.0
    for k in range(places.size):
        data[places[k]] += values[k]


@kernel
def constrain(indptr, indices, data, fixed, change, rhs, scale):
    """Prescribe unknowns: move their columns to the right side, keep the symmetry.

    fixed : array of bool; change : prescribed values; scale : their diagonal entry.
    """
    for c in range(indptr.size - 1):
        for k in range(indptr[c], indptr[c + 1]):
            r = indices[k]
            if fixed[c]:
                if not fixed[r]:
                    rhs[r] -= data[k] * change[c]
                data[k] = scale if r == c else 0.0
            elif fixed[r]:
                data[k] = 0.0
        if fixed[c]:
            rhs[c] = scale * change[c]
