# SPDX-License-Identifier: MIT
"""C structs as Python objects. A field is read and written where it lies; vectors are NumPy views into it."""

import difflib
from typing import Any, ClassVar, Generic, Optional, Tuple, Type, TypeVar, Union, overload

import numpy as np
import numpy.typing as npt

from ._errors import ArgumentError
from ._layout import DType, dtype_of
from ._tahr import ffi

Floats = npt.NDArray[np.float64]
R = TypeVar("R", bound="Record")
P = TypeVar("P", bound="Plain")
Self = TypeVar("Self", bound="_Field")


def numbers(value: npt.ArrayLike, shape: Tuple[int, ...], what: str) -> Floats:
    """value as float64 of that shape, or an ArgumentError that names it."""
    try:
        array = np.asarray(value)
    except ValueError as error:
        raise ArgumentError(f"{what}: expected {shape} numbers, got {value!r}") from error
    if array.dtype.kind not in "fiu" or array.shape != shape:
        raise ArgumentError(f"{what}: expected numbers of shape {shape}, got {array.dtype} of shape {array.shape}")
    return array.astype(np.float64, copy=False)


class _Field:
    """A field of a struct, as a descriptor."""

    def __init__(self, document: str) -> None:
        self.__doc__ = document
        self.name = ""

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def label(self, record: "Record") -> str:
        return f"{type(record).__name__}.{self.name}"


class _Number(_Field):
    def write(self, record: "Record", value: Any, kind: str) -> None:
        try:
            setattr(record._c, self.name, value)
        except (TypeError, OverflowError) as error:
            raise ArgumentError(f"{self.label(record)}: expected {kind}, got {value!r}") from error


class Real(_Number):
    """A float."""

    @overload
    def __get__(self, record: None, owner: type) -> "Real": ...
    @overload
    def __get__(self, record: "Record", owner: type) -> float: ...
    def __get__(self, record: Optional["Record"], owner: type) -> Union["Real", float]:
        return self if record is None else float(getattr(record._c, self.name))

    def __set__(self, record: "Record", value: float) -> None:
        self.write(record, value, "a number")


class Integer(_Number):
    """An int: a count, a switch, flags."""

    @overload
    def __get__(self, record: None, owner: type) -> "Integer": ...
    @overload
    def __get__(self, record: "Record", owner: type) -> int: ...
    def __get__(self, record: Optional["Record"], owner: type) -> Union["Integer", int]:
        return self if record is None else int(getattr(record._c, self.name))

    def __set__(self, record: "Record", value: int) -> None:
        self.write(record, value, "an integer of the field's range")


class Fixed(Integer):
    """An int that C or the class itself writes."""

    def __set__(self, record: "Record", value: int) -> None:
        raise ArgumentError(f"{self.label(record)}: is {self.__get__(record, Record)}, and not to be set")


class Vector(_Field):
    """A view, float64 of shape (length,); assigning copies into it."""

    def __init__(self, length: int, document: str) -> None:
        super().__init__(document)
        self.length = length

    @overload
    def __get__(self, record: None, owner: type) -> "Vector": ...
    @overload
    def __get__(self, record: "Record", owner: type) -> Floats: ...
    def __get__(self, record: Optional["Record"], owner: type) -> Union["Vector", Floats]:
        if record is None:
            return self
        view: Floats = record._memory[self.name]
        return view

    def __set__(self, record: "Record", value: npt.ArrayLike) -> None:
        record._memory[self.name][:] = numbers(value, (self.length,), self.label(record))


class Integers(_Field):
    """A view of integers of shape (length,), not to be assigned as a whole."""

    def __init__(self, length: int, document: str) -> None:
        super().__init__(document)
        self.length = length

    @overload
    def __get__(self, record: None, owner: type) -> "Integers": ...
    @overload
    def __get__(self, record: "Record", owner: type) -> npt.NDArray[np.uint32]: ...
    def __get__(self, record: Optional["Record"], owner: type) -> Union["Integers", npt.NDArray[np.uint32]]:
        if record is None:
            return self
        view: npt.NDArray[np.uint32] = record._memory[self.name]
        return view

    def __set__(self, record: "Record", value: npt.ArrayLike) -> None:
        raise ArgumentError(f"{self.label(record)}: write its elements, not the whole")


class Nested(_Field, Generic[R]):
    """A struct in a struct: a view of it; assigning copies into it."""

    def __init__(self, kind: Type[R], document: str) -> None:
        super().__init__(document)
        self.kind = kind

    @overload
    def __get__(self, record: None, owner: type) -> "Nested[R]": ...
    @overload
    def __get__(self, record: "Record", owner: type) -> R: ...
    def __get__(self, record: Optional["Record"], owner: type) -> Union["Nested[R]", R]:
        if record is None:
            return self
        return self.kind._view(ffi.addressof(record._c[0], self.name), record._memory[self.name])

    def __set__(self, record: "Record", value: R) -> None:
        if not isinstance(value, self.kind):
            raise ArgumentError(f"{self.label(record)}: expected a {self.kind.__name__}, got {value!r}")
        setattr(record._c, self.name, value._c[0])


class Record:
    """A C struct. Keyword arguments set fields; all others are zero unless the class says otherwise."""

    __slots__ = ("_c", "_array")
    ctype: ClassVar[str] = ""
    dtype: ClassVar[DType]
    _pointer: ClassVar[Any]
    _sized: ClassVar[bool]

    def __init_subclass__(cls) -> None:
        if cls.ctype:
            cls.dtype = dtype_of(cls.ctype)
            cls._pointer = ffi.typeof(cls.ctype + " *")
            cls._sized = "struct_size" in (cls.dtype.names or ())

    def __init__(self, **fields: Any) -> None:
        self._c = ffi.new(self._pointer)
        self._array: Optional[npt.NDArray[Any]] = None
        if self._sized:
            self._c.struct_size = self.dtype.itemsize
        self.update(**fields)

    @classmethod
    def _view(cls: Type[R], c: Any, array: Optional[npt.NDArray[Any]] = None) -> R:
        """c: a pointer to the struct, which owns it; or array, of shape (), is the same memory and keeps it."""
        record = cls.__new__(cls)
        record._c = c
        record._array = array
        return record

    @classmethod
    def _copied(cls: Type[R], c: Any) -> R:
        """Memory of its own, for what is C's only for a while."""
        record = cls._view(ffi.new(cls._pointer))
        ffi.memmove(record._c, c, cls.dtype.itemsize)
        if cls._sized:
            record._c.struct_size = cls.dtype.itemsize
        return record

    @property
    def _memory(self) -> npt.NDArray[Any]:
        if self._array is None:
            self._array = np.frombuffer(ffi.buffer(self._c), dtype=self.dtype).reshape(())
        return self._array

    @property
    def array(self) -> npt.NDArray[Any]:
        """The same memory as a structured array of shape (), dtype as the class's; read-only where C trusts a size or
        an address in it."""
        view = self._memory[...]
        if self._sized or not isinstance(self, Plain):
            view.flags.writeable = False
        return view

    def update(self, **fields: Any) -> None:
        """Sets fields by name."""
        for name, value in fields.items():
            if not isinstance(getattr(type(self), name, None), _Field):
                near = difflib.get_close_matches(name, self.fields(), 1)
                hint = f"; did you mean {near[0]}?" if near else ""
                raise ArgumentError(f"{type(self).__name__} has no field {name}{hint}")
            setattr(self, name, value)

    @classmethod
    def fields(cls) -> Tuple[str, ...]:
        """The names of the fields that can be read and written."""
        return tuple(name for name in (cls.dtype.names or ()) if isinstance(getattr(cls, name, None), _Field))

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={getattr(self, name)!r}" for name in self.fields())
        return f"{type(self).__name__}({values})"


class Plain(Record):
    """A struct without pointers: its bytes are all there is to it. Can be copied, compared, pickled."""

    __slots__ = ()

    def __bytes__(self) -> bytes:
        return bytes(ffi.buffer(self._c))

    @classmethod
    def from_bytes(cls: Type[P], data: bytes) -> P:
        """The opposite of bytes(record); of as many bytes."""
        if len(data) != cls.dtype.itemsize:
            raise ArgumentError(f"{cls.__name__}.from_bytes: expected {cls.dtype.itemsize} bytes, got {len(data)}")
        return cls._copied(ffi.from_buffer(data))

    def copy(self: P) -> P:
        """A snapshot: the same bytes in memory of its own."""
        return self.from_bytes(bytes(self))

    def assign(self: P, other: P) -> None:
        """Becomes the same bytes as another record of this class: back to a snapshot."""
        if not isinstance(other, type(self)):
            raise ArgumentError(f"{type(self).__name__}.assign: expected a {type(self).__name__}, got {other!r}")
        ffi.memmove(self._c, other._c, self.dtype.itemsize)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Plain) and type(other) is type(self) and bytes(self) == bytes(other)

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> Tuple[Any, Tuple[bytes]]:
        return (self.from_bytes, (bytes(self),))
