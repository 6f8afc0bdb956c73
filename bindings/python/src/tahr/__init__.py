# SPDX-License-Identifier: MIT
"""Character movement over any collision engine: the C library Tahr, from Python.

    world = tahr.World.from_mesh(vertices, triangles)     # or from_file, from_callbacks, World([tahr.Body.box(...)])
    mover = tahr.Mover(world, tahr.Config(max_speed=5))
    state = tahr.State(mover.config, position=(0, 0, 1))
    mover.step(state, tahr.Input(move=(1, 0, 0)), 1 / 60)

Metres, seconds, radians; right-handed, z up unless gravity says otherwise. Names, fields and numbers are those of the C
headers: TAHR_MODE_WALKING is tahr.MODE_WALKING, tahr_state is tahr.State, an array of it has the dtype tahr.STATE.
Errors are exceptions named after the library's statuses, all of them tahr.Error.
"""

from . import _constants, _errors
from ._constants import *  # noqa: F403
from ._error import ClosedError, Error, InUseError
from ._errors import *  # noqa: F403
from ._layout import check_layout
from ._records import Base, Bounds, Contact, CrowdCounts, Floor, Hit, Input, Pose, Shape
from ._status import status_name
from ._tahr import ffi, lib
from .arrays import (
    BODY_POSE,
    CONTACT,
    DECISION,
    DELAY,
    EVENT,
    HIT,
    INPUT,
    MEMBER,
    QUERY_RECORD,
    REPORT,
    STATE,
    hashes,
    inputs,
    members,
    poses,
    states,
)
from .body import Body
from .config import Config
from .crowd import Crowd
from .custom_mode import Step
from .level import load_level
from .mover import Mover
from .query import BodyMotion, ContactQuery, Fluid, FluidQuery, Ray, Sweep
from .report import Report, event_name, rule_name, shortcut_name
from .state import State, mode_name
from .world import World, backends

__version__: str = ffi.string(lib.tahr_version()).decode()

if lib.tahr_abi_check(lib.TAHR_ABI) < 0:
    raise ImportError(f"tahr: made for another ABI than that of its C library {__version__}: install it anew")
check_layout()
del check_layout, ffi, lib

__all__ = [
    "BODY_POSE",
    "Base",
    "Body",
    "BodyMotion",
    "Bounds",
    "CONTACT",
    "ClosedError",
    "Config",
    "Contact",
    "ContactQuery",
    "Crowd",
    "CrowdCounts",
    "DECISION",
    "DELAY",
    "EVENT",
    "Error",
    "Floor",
    "Fluid",
    "FluidQuery",
    "HIT",
    "Hit",
    "INPUT",
    "InUseError",
    "Input",
    "MEMBER",
    "Mover",
    "Pose",
    "QUERY_RECORD",
    "REPORT",
    "Ray",
    "Report",
    "STATE",
    "Shape",
    "State",
    "Step",
    "Sweep",
    "World",
    "backends",
    "event_name",
    "hashes",
    "inputs",
    "load_level",
    "members",
    "mode_name",
    "poses",
    "rule_name",
    "shortcut_name",
    "states",
    "status_name",
]
__all__ += _constants.__all__
__all__ += _errors.__all__
