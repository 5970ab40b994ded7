"""Points as balls of one radius."""

from dataclasses import dataclass
from typing import Any, ClassVar, List, Optional, Tuple

import numpy as np

from deformable_manipulation.geometry.cloud_files import FORMATS, read_cloud
from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.obstacles.drawings import Dots, Drawing
from deformable_manipulation.obstacles.motions import Motion
from deformable_manipulation.obstacles.spec import (
    KNOWN,
    MOTION_OF_OBSTACLE,
    NAME,
    REAL,
    ROTATION,
    TRANSLATION,
    ObstacleSpec,
)
from deformable_manipulation.reading.files import CheckedFile
from deformable_manipulation.reading.origin import SPACE_ORIGIN, origin_beside
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import LARGEST_COORDINATE, Number

_CLOUD_FILE = CheckedFile(
    "the name of a file of points ({})".format(FORMATS),
    lambda path, node: read_cloud(path, origin_beside(node, 3)),
)


@dataclass(frozen=True)
class CloudObstacle(ObstacleSpec):
    """The points of a file as balls.

    A point p of the file lies at ``translation + rotation * (p - origin)``.
    """

    kind: ClassVar[str] = "cloud"
    name: str = NAME
    cloud: str = parameter(
        _CLOUD_FILE, "PCD, PLY, XYZ or NPY; any number of points.", allowed="see below"
    )
    radius: float = parameter(
        Number("m", at_least=0.0, at_most=LARGEST_COORDINATE),
        "Of the ball around each point. With at least 0.7 of the distance of neighbours, the balls "
        "leave no holes in a surface.",
    )
    translation: Vector = TRANSLATION
    rotation: Quaternion = ROTATION
    origin: Vector = parameter(
        SPACE_ORIGIN,
        "Subtracted from all points of the file. Use it for files whose coordinates are far from "
        "0.",
        default=(0.0, 0.0, 0.0),
    )
    motion: Optional[Motion] = MOTION_OF_OBSTACLE
    known: bool = KNOWN
    real: bool = REAL

    def native(self) -> Tuple[Any, List[str]]:
        from deformable_manipulation import _distance

        return _distance.CloudObstacle(_distance.PointCloud(self._points()), self.radius), []

    def corners(self) -> np.ndarray:
        points = self._points()
        low, high = points.min(axis=0) - self.radius, points.max(axis=0) + self.radius
        return np.stack(np.meshgrid(*zip(low, high)), axis=-1).reshape(-1, 3)

    def drawing(self) -> Drawing:
        return Dots(self._points(), 2.0 * self.radius)

    def description(self) -> str:
        return "cloud {}, radius {:g} m".format(self.cloud, self.radius)

    def _points(self) -> np.ndarray:
        return read_cloud(self.cloud, self.origin)
