"""A packing of truncated spheres that is relaxed by geometry alone."""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

DIE_RADIUS = 1.0e-3


@dataclass
class Powder:
    """Positions and radii, and what holds them."""

    position: np.ndarray
    radius: np.ndarray
    height: float

    def pairs(self):
        near = cKDTree(self.position).query_pairs(
            2.02 * self.radius.max(), output_type="ndarray"
        )
        offset = self.position[near[:, 0]] - self.position[near[:, 1]]
        distance = np.linalg.norm(offset, axis=1)
        overlap = self.radius[near].sum(axis=1) - distance
        use = overlap > 0
        return near[use], offset[use] / distance[use, None], overlap[use]

    def walls(self):
        """Yield (wall number, normal into the powder, overlap) over all particles."""
        across = np.linalg.norm(self.position[:, :2], axis=1)
        inward = np.zeros_like(self.position)
        inward[:, :2] = -self.position[:, :2] / np.maximum(across, 1e-12)[:, None]
        yield 0, inward, across + self.radius - DIE_RADIUS
        up = np.broadcast_to([0.0, 0.0, 1.0], self.position.shape)
        yield 1, up, self.radius - self.position[:, 2]
        yield 2, -up, self.radius - (self.height - self.position[:, 2])

    def relax(self, rounds):
        for _ in range(rounds):
            pair, normal, overlap = self.pairs()
            push = np.zeros_like(self.position)
            for end, sign in ((0, 0.25), (1, -0.25)):
                np.add.at(push, pair[:, end], sign * overlap[:, None] * normal)
            for _, inward, deep in self.walls():
                push += 0.5 * np.maximum(deep, 0.0)[:, None] * inward
            self.position += push

    def contacts(self, bound=True):
        pair, normal, overlap = self.pairs()
        i, j = pair.T
        distance = self.radius[i] + self.radius[j] - overlap
        flat = (distance**2 + self.radius[i] ** 2 - self.radius[j] ** 2) / (
            2 * distance
        )
        parts = [(i + 1, j + 1, normal, overlap, flat, self.radius[i])]
        for wall, inward, deep in self.walls() if bound else ():
            (row,) = np.nonzero(deep > 0)
            flat = self.radius[row] - deep[row]
            ends = np.full(len(row), -1 - wall)
            parts.append(
                (row + 1, ends, inward[row], deep[row], flat, self.radius[row])
            )
        first, second, normal, overlap, flat, radius = (
            np.concatenate(column) for column in zip(*parts, strict=True)
        )
        area = np.pi * np.maximum(radius**2 - flat**2, 0.0)
        pressure = 250e6 * np.sqrt(overlap / radius)
        return {
            "first": first,
            "second": second,
            "force": (area * pressure)[:, None] * normal,
            "normal": normal,
            "overlap": overlap,
            "flat": flat,
            "area": area,
            "pressure": pressure,
            "yielded": overlap > 0.02 * radius,
        }

    def particles(self, initial, contacts):
        count = len(self.radius)
        volume = 4 / 3 * np.pi * initial**3
        stress = np.zeros((count, 3, 3))
        first = contacts["first"] - 1
        branch = contacts["normal"] * contacts["flat"][:, None]
        moment = np.einsum("ci,cj->cij", contacts["force"], branch)
        np.add.at(stress, first, moment)
        pair = contacts["second"] > 0
        np.add.at(stress, contacts["second"][pair] - 1, moment[pair])
        stress /= volume[:, None, None]
        yielded = np.bincount(first, contacts["yielded"], count).astype(int)
        return {
            "id": np.arange(1, count + 1),
            "position": self.position.copy(),
            "radius": self.radius.copy(),
            "radius_initial": initial,
            "velocity": np.zeros((count, 3)),
            "angular_velocity": np.zeros((count, 3)),
            "material": np.zeros(count, dtype=np.int32),
            "stress": stress,
            "plastic_contacts": yielded,
        }
