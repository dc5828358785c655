"""Moduli of isotropic bodies and of pairs of them."""


def plane_strain_modulus(youngs_modulus: float, poisson_ratio: float) -> float:
    r"""Plane-strain modulus of one body, :math:`E/(1-\nu^2)`.

    Parameters
    ----------
    youngs_modulus, poisson_ratio : float
        Elastic constants E [Pa], nu [-].

    Returns
    -------
    float
        Modulus [Pa]; the composite modulus of the body against a rigid one.

    Examples
    --------
    >>> round(plane_strain_modulus(1.0, 0.3), 6)
    1.098901
    """
    return youngs_modulus / (1.0 - poisson_ratio**2)


def composite_modulus(first: float, second: float | None = None) -> float:
    r"""Composite plane-strain modulus E* of two bodies, Eq. (3).

    .. math:: 1/E^* = (1-\nu_1^2)/E_1 + (1-\nu_2^2)/E_2

    Parameters
    ----------
    first, second : float
        Plane-strain moduli of the bodies [Pa]; None stands for a rigid body.

    Returns
    -------
    float
        E* [Pa].

    Examples
    --------
    >>> composite_modulus(2.0, 2.0), composite_modulus(2.0)
    (1.0, 2.0)
    """
    return first if second is None else first * second / (first + second)


def shear_modulus(youngs_modulus: float, poisson_ratio: float) -> float:
    r"""Shear modulus G, :math:`E/(2(1+\nu))`.

    Parameters
    ----------
    youngs_modulus, poisson_ratio : float
        Elastic constants E [Pa], nu [-].

    Returns
    -------
    float
        G [Pa].

    Examples
    --------
    >>> shear_modulus(2.5, 0.25)
    1.0
    """
    return youngs_modulus / (2.0 * (1.0 + poisson_ratio))


def bulk_modulus(youngs_modulus: float, poisson_ratio: float) -> float:
    r"""Bulk modulus kappa, :math:`E/(3(1-2\nu))`.

    Parameters
    ----------
    youngs_modulus, poisson_ratio : float
        Elastic constants E [Pa], nu [-].

    Returns
    -------
    float
        kappa [Pa].

    Examples
    --------
    >>> bulk_modulus(1.5, 0.25)
    1.0
    """
    return youngs_modulus / (3.0 * (1.0 - 2.0 * poisson_ratio))
