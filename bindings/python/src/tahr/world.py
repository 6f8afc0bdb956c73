# SPDX-License-Identifier: MIT
"""A world: a scene on a backend, or the answers of Python functions."""

import contextlib
import os
import re
from typing import Any, Dict, Iterable, Iterator, List, Mapping, Optional, Tuple, Type, Union

import numpy as np
import numpy.typing as npt

from . import _callbacks
from ._arrays import pointer_to
from ._callbacks import Functions
from ._constants import CALLBACKS_NO_MARGIN, CALLBACKS_PROBE
from ._errors import ArgumentError, MemoryError, NotFoundError
from ._layout import dtype_of
from ._records import Hit
from ._status import check, error_of
from ._tahr import ffi, lib
from .body import Body
from .level import load_level
from .query import BodyMotion, ContactQuery, Fluid, FluidQuery, Ray, Sweep

Answers = npt.NDArray[Any]

_MOST_ANSWERS = 64  # of one question: the library's own limit
_OF_C = re.compile("^struct_size$|^reserved|^world|_count$")  # numbers that go with addresses
_plugins: Dict[str, Any] = {}


def backends() -> Tuple[str, ...]:
    """The names of the backends in this package; "native" is always one of them."""
    return tuple(_linked())


def _linked() -> Dict[str, Any]:
    found: Dict[str, Any] = {}
    while lib.glue_backend(len(found)) != ffi.NULL:
        backend = lib.glue_backend(len(found))
        found[ffi.string(backend.name).decode()] = backend
    return found


def _backend_of(name: str) -> Any:
    """A backend by its name, or by the path of a plugin, which stays loaded."""
    linked = _linked()
    if name in linked:
        return linked[name]
    if os.sep not in name:
        raise NotFoundError(f"World: no backend {name!r}; there are {', '.join(linked)}, and plugins by their path")
    if name not in _plugins:
        plugin = ffi.new("tahr_plugin **")
        lib.glue_forget()
        check(lib.tahr_plugin_load(os.fsencode(name), lib.glue_log(), plugin), "World: backend")
        _plugins[name] = lib.tahr_plugin_backend(plugin[0])
    return _plugins[name]


def _options_of(backend: str, options: Optional[Mapping[str, Any]]) -> Any:
    """The backend's own description, tahr_NAME_desc, with its numbers set."""
    if not options:
        return ffi.NULL
    try:
        kind = ffi.typeof(f"tahr_{backend}_desc")
    except ffi.error:
        raise ArgumentError(f"World: options: backend {backend!r} has none that Python can set") from None
    known = [name for name, info in kind.fields if info.type.kind == "primitive" and not _OF_C.search(name)]
    made = ffi.new(f"tahr_{backend}_desc *", {"struct_size": ffi.sizeof(kind)})
    for name, value in options.items():
        if name not in known:
            raise ArgumentError(f"World: options: {backend!r} has no {name!r}, expected some of {', '.join(known)}")
        try:
            setattr(made, name, value)
        except (TypeError, OverflowError) as error:
            raise ArgumentError(f"World: options[{name!r}] is {value!r}, expected a number of its range") from error
    return made


def _describe_to(lines: List[str]) -> Tuple[Any, Any]:
    handle = ffi.new_handle(lines)
    return handle, ffi.new("tahr_log *", {"user": handle, "write": lib.python_line})


class World:
    """A scene, opened on a backend. bodies: their ids are their places in the list.

    backend: one of tahr.backends(), or the path of a plugin (with a slash in it). options: the backend's own numbers,
    by the names that its C header gives them: {"cache_triangles": 32}.

    Movers and crowds keep their world alive. Any number of threads may step and ask; what changes a world (set, move,
    touch, record, close) raises ReentrantError while they do. Raises ArgumentError, GeometryError, UnsupportedError
    (the backend cannot hold such a body), NotFoundError (no such backend): the text names body and field.
    """

    def __init__(
        self, bodies: Iterable[Body] = (), *, backend: str = "native", options: Optional[Mapping[str, Any]] = None
    ) -> None:
        scene = list(bodies)
        for i, body in enumerate(scene):
            if not isinstance(body, Body):
                raise ArgumentError(f"World: bodies[{i}] is a {type(body).__name__}, expected a tahr.Body")
        described = ffi.new("tahr_body_desc[]", max(len(scene), 1))
        for i, body in enumerate(scene):
            described[i] = body._c[0]
        found = _backend_of(backend)
        desc = self._describe(described, len(scene))
        kept = _options_of(ffi.string(found.name).decode(), options)
        desc.options = kept
        opened = ffi.new("tahr_world **")
        lib.glue_forget()
        check(lib.tahr_world_open(found, desc, opened), "World")
        self._hold(opened[0], None)

    @staticmethod
    def _describe(bodies: Any, count: int) -> Any:
        desc = ffi.new("tahr_world_desc *")
        lib.tahr_world_desc_init(desc, ffi.sizeof("tahr_world_desc"))
        desc.bodies = bodies
        desc.body_count = count
        desc.log = lib.glue_log()
        return desc

    def _hold(self, world: Any, functions: Optional[Functions]) -> None:
        held = lib.glue_world_hold(world)
        if held == ffi.NULL:
            raise MemoryError("World: an allocation failed")
        self._functions = functions
        self._c = ffi.gc(held, lib.glue_world_drop)

    @classmethod
    def from_mesh(
        cls,
        vertices: npt.ArrayLike,
        triangles: npt.ArrayLike,
        *,
        bodies: Iterable[Body] = (),
        backend: str = "native",
        options: Optional[Mapping[str, Any]] = None,
        **fields: Any,
    ) -> "World":
        """A level of triangles, which is body 0, and other bodies after it. vertices: (n, 3), m; triangles: (m, 3)
        indices, counter-clockwise seen from the front; fields: those of Body. Both are copied."""
        return cls([Body.mesh(vertices, triangles, **fields), *bodies], backend=backend, options=options)

    @classmethod
    def from_file(
        cls,
        path: Union[str, "os.PathLike[str]"],
        *,
        up: str = "y",
        bodies: Iterable[Body] = (),
        backend: str = "native",
        options: Optional[Mapping[str, Any]] = None,
        **fields: Any,
    ) -> "World":
        """A level from a file (OBJ, glTF, STL, ...: what trimesh reads, of the extra `levels`), which is body 0.
        up: the file's axis, "y" or "z"; z is up in the world. Raises NotFoundError, FileError."""
        return cls.from_mesh(*load_level(path, up), bodies=bodies, backend=backend, options=options, **fields)

    @classmethod
    def from_callbacks(
        cls,
        sweep: _callbacks.SweepFunction,
        *,
        contacts: Optional[_callbacks.ContactsFunction] = None,
        ray: Optional[_callbacks.RayFunction] = None,
        sensors: Optional[_callbacks.SensorsFunction] = None,
        body: Optional[_callbacks.BodyFunction] = None,
        fluid: Optional[_callbacks.FluidFunction] = None,
        margin: bool = True,
        probe: bool = False,
    ) -> "World":
        """A world whose geometry is behind Python functions: for teaching, tests, an engine that Python reaches.

        sweep(query) returns a Hit, or None where the way is free; it honours query.margin (unless margin=False).
        Optional: contacts(query) and sensors(query) return lists of Contact and Hit, ray(query) a Hit or None,
        body(id) a BodyMotion or None (it is gone), fluid(query) a Fluid or None. What C derives where one is missing,
        and what probe does, tahr/world.h says. What a function raises comes out of the step that asked.
        """
        given = dict(sweep=sweep, contacts=contacts, ray=ray, sensors=sensors, body=body, fluid=fluid)
        for name, function in given.items():
            if not callable(function) and (function is not None or name == "sweep"):
                raise ArgumentError(f"World.from_callbacks: {name} is {function!r}, expected a function")
        functions = Functions(**given)
        flags = (0 if margin else CALLBACKS_NO_MARGIN) | (CALLBACKS_PROBE if probe else 0)
        callbacks = ffi.new("tahr_callbacks *", {"struct_size": ffi.sizeof("tahr_callbacks"), "flags": flags})
        callbacks.user = functions.handle
        for name, function in given.items():
            if function is not None:
                setattr(callbacks, name, getattr(lib, f"python_{name}"))
        opened = ffi.new("tahr_world **")
        lib.glue_forget()
        check(lib.tahr_world_open_callbacks(callbacks, cls._describe(ffi.NULL, 0), opened), "World.from_callbacks")
        world = cls.__new__(cls)
        world._hold(opened[0], functions)
        return world

    def close(self) -> None:
        """Closes the world now. A second time does nothing. Raises InUseError while movers or crowds of it are open,
        ReentrantError while another thread uses it."""
        if not self.closed:
            check(lib.glue_world_close(self._c), "World.close")

    @property
    def closed(self) -> bool:
        """Whether close() was called."""
        return bool(lib.glue_world_is_closed(self._c))

    def __enter__(self) -> "World":
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: object, traceback: object) -> None:
        self.close()

    def _failed(self, status: int, caller: str, any_thread: bool = False) -> BaseException:
        """What to raise for a status: what one of the world's functions raised, or the library's own complaint."""
        raised = self._functions.take(any_thread) if self._functions else None
        return raised if raised is not None else error_of(status, caller)

    @contextlib.contextmanager
    def _entered(self, caller: str) -> Iterator[Any]:
        """The C world, which nobody changes meanwhile."""
        world = ffi.new("tahr_world **")
        check(lib.glue_world_enter(self._c, world), caller)
        try:
            yield world[0]
        finally:
            lib.glue_world_leave(self._c)

    def _check(self, status: int, caller: str) -> int:
        if status < 0:
            raise self._failed(status, caller)
        return status

    def sweep(self, query: Sweep, capacity: int = _MOST_ANSWERS) -> Answers:
        """What a shape meets on its way: an array of HIT, sensors first, then the first that blocks; empty: free.
        Of more than capacity (1..64) sensors the last are left out; capacity 1 asks for what blocks only."""
        hits = np.zeros(min(max(capacity, 1), _MOST_ANSWERS), dtype_of("tahr_hit"))
        count = ffi.new("uint32_t *")
        with self._entered("World.sweep") as world:
            status = lib.tahr_world_sweep(world, query._c, ffi.from_buffer("tahr_hit[]", hits), len(hits), count)
        self._check(status, "World.sweep")
        return hits[: count[0]]

    def contacts(self, query: ContactQuery, capacity: int = _MOST_ANSWERS) -> Answers:
        """What is within query.margin of a shape: an array of CONTACT, nearest first, at most capacity (1..64)."""
        found = np.zeros(min(max(capacity, 1), _MOST_ANSWERS), dtype_of("tahr_contact"))
        count = ffi.new("uint32_t *")
        with self._entered("World.contacts") as world:
            out = ffi.from_buffer("tahr_contact[]", found)
            status = lib.tahr_world_contacts(world, query._c, out, len(found), count)
        self._check(status, "World.contacts")
        return found[: count[0]]

    def ray(self, query: Ray) -> Optional[Hit]:
        """What a segment meets first; None: nothing."""
        hit, count = Hit(), ffi.new("uint32_t *")
        with self._entered("World.ray") as world:
            status = lib.tahr_world_ray(world, query._c, hit._c, count)
        self._check(status, "World.ray")
        return hit if count[0] else None

    def fluid(self, query: FluidQuery) -> Fluid:
        """How deep a shape is in the fluids of the world: immersion 0 where there is none."""
        fluid = Fluid()
        with self._entered("World.fluid") as world:
            status = lib.tahr_world_fluid(world, query._c, fluid._c)
        self._check(status, "World.fluid")
        return fluid

    def body(self, body: int) -> BodyMotion:
        """How a body moves now. Raises NotFoundError."""
        motion = BodyMotion()
        with self._entered("World.body") as world:
            status = lib.tahr_world_body(world, body, motion._c)
        self._check(status, "World.body")
        return motion

    def set(self, poses: Answers) -> None:
        """Places movable bodies at rest; poses: tahr.poses(...). All or nothing. Raises NotFoundError, ArgumentError,
        UnsupportedError, ReentrantError."""
        out = pointer_to(poses, "tahr_body_pose", "World.set", "poses", None, write=False)
        self._check(lib.glue_world_move(self._c, out, len(poses), 0.0), "World.set")

    def move(self, poses: Answers, dt: float) -> None:
        """Moves bodies to poses (tahr.poses(...)) within dt (s, above 0, up to 10): once a tick, before the steps, with
        every body that moves in it. Who stands on them is carried, who is in their way is pushed. Raises as set."""
        if not 0 < dt:
            raise ArgumentError(f"World.move: dt is {dt!r}, expected seconds above 0")
        out = pointer_to(poses, "tahr_body_pose", "World.move", "poses", None, write=False)
        self._check(lib.glue_world_move(self._c, out, len(poses), dt), "World.move")

    def touch(self) -> None:
        """What lies behind the functions of a world has changed: nothing that was known of it counts any more."""
        self._check(lib.glue_world_touch(self._c), "World.touch")

    @contextlib.contextmanager
    def recording(self, path: Union[str, "os.PathLike[str]"]) -> Iterator[None]:
        """Records every step of a with block, and all that was asked, to a file that `tahr replay` repeats bit for bit.
        One call at a time may use the world meanwhile. Raises FileError, InUseError (recorded already)."""
        self._check(lib.glue_world_record(self._c, os.fsencode(path), 0), "World.recording")
        try:
            yield
        finally:
            self._check(lib.glue_world_record_end(self._c), "World.recording")

    @property
    def revision(self) -> int:
        """A number that changes when the world does; the same again when bodies are put back."""
        with self._entered("World.revision") as world:
            return int(lib.tahr_world_revision(world))

    @property
    def backend(self) -> str:
        """The name of the backend: "native", "callbacks"."""
        with self._entered("World.backend") as world:
            return str(ffi.string(lib.tahr_world_backend_name(world)).decode())

    @property
    def memory(self) -> int:
        """Bytes that the world holds, without what movers and crowds of it do."""
        with self._entered("World.memory") as world:
            return int(lib.tahr_world_memory(world))

    def describe(self) -> List[str]:
        """In words what the world is made of and which way questions go through it; for people."""
        lines: List[str] = []
        kept, log = _describe_to(lines)
        with self._entered("World.describe") as world:
            status = lib.tahr_world_describe(world, log)
        self._check(status, "World.describe")
        del kept
        return lines
