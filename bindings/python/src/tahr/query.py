# SPDX-License-Identifier: MIT
"""What a world is asked, and what moves in it: records with sensible beginnings."""

from typing import Any

from ._constants import NO_BODY
from ._records import (
    BodyMotionFields,
    ContactQueryFields,
    FluidFields,
    FluidQueryFields,
    RayFields,
    SweepFields,
)

_ALL = 0xFFFFFFFF
_UPRIGHT = (0.0, 0.0, 1.0)
_LEVEL = (0.0, 0.0, 0.0, 1.0)


class Sweep(SweepFields):
    """How far can this shape go along this motion? Meets all bodies, upright along +z, unless told otherwise."""

    __slots__ = ()

    def __init__(self, **fields: Any) -> None:
        super().__init__(mask=_ALL, ignore_body=NO_BODY, up=_UPRIGHT, orientation=_LEVEL)
        self.update(**fields)


class ContactQuery(ContactQueryFields):
    """What is within margin of this shape here? Meets all bodies, upright along +z, unless told otherwise."""

    __slots__ = ()

    def __init__(self, **fields: Any) -> None:
        super().__init__(mask=_ALL, ignore_body=NO_BODY, up=_UPRIGHT, orientation=_LEVEL)
        self.update(**fields)


class Ray(RayFields):
    """What does this segment meet first? From origin to origin + motion; meets all bodies unless told otherwise."""

    __slots__ = ()

    def __init__(self, **fields: Any) -> None:
        super().__init__(mask=_ALL, ignore_body=NO_BODY)
        self.update(**fields)


class FluidQuery(FluidQueryFields):
    """How deep is this upright shape in a fluid? Asks all bodies, along +z, unless told otherwise."""

    __slots__ = ()

    def __init__(self, **fields: Any) -> None:
        super().__init__(mask=_ALL, up=_UPRIGHT)
        self.update(**fields)


class Fluid(FluidFields):
    """A fluid around a shape; none unless told otherwise."""

    __slots__ = ()

    def __init__(self, **fields: Any) -> None:
        super().__init__(body=NO_BODY)
        self.update(**fields)


class BodyMotion(BodyMotionFields):
    """How a body moves; at rest at the origin unless told otherwise."""

    __slots__ = ()

    def __init__(self, **fields: Any) -> None:
        super().__init__()
        self.pose.orientation = _LEVEL
        self.update(**fields)
