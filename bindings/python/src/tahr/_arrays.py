# SPDX-License-Identifier: MIT
"""From a NumPy array to a pointer, if it is just what C expects."""

from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from ._errors import ArgumentError
from ._layout import DType, dtype_of
from ._tahr import ffi

_types = {
    name: ffi.typeof(name + "[]")
    for name in ("tahr_state", "tahr_input", "tahr_report", "tahr_event", "tahr_member", "tahr_delay", "tahr_body_pose")
}
_types["int32_t"] = ffi.typeof("int32_t[]")


def _refuse(array: Any, dtype: DType, name: str, caller: str, what: str, count: Optional[int], write: bool) -> None:
    """Says the first thing that is wrong with an array."""
    if name == "int32_t":
        wanted = "np.int32"
    else:
        wanted = f"tahr.{name[5:].upper()}"
    if not isinstance(array, np.ndarray):
        raise ArgumentError(f"{caller}: {what} is a {type(array).__name__}, expected a NumPy array of dtype {wanted}")
    if array.dtype != dtype:
        raise ArgumentError(f"{caller}: {what} has dtype {str(array.dtype)[:80]}, expected {wanted}")
    if array.ndim != 1:
        raise ArgumentError(f"{caller}: {what} has shape {array.shape}, expected (n,)")
    if count is not None and len(array) != count:
        raise ArgumentError(f"{caller}: {what} has {len(array)} elements, expected {count}, one for each character")
    if not array.flags.c_contiguous:
        raise ArgumentError(f"{caller}: {what} is not contiguous, expected C order without gaps")
    if write and not array.flags.writeable:
        raise ArgumentError(f"{caller}: {what} is read-only, expected a writeable array")


_INT32 = np.dtype(np.int32)


def pointer_to(
    array: npt.NDArray[Any], name: str, caller: str, what: str, count: Optional[int], write: bool = True
) -> Any:
    """The memory of a contiguous array of shape (count,), as C's array of `name`; it keeps the array alive. Raises
    ArgumentError: wrong type, dtype, shape, length, order, or read-only."""
    dtype = _INT32 if name == "int32_t" else dtype_of(name)
    try:
        flags = array.flags
        fits = (
            (array.dtype is dtype or array.dtype == dtype)
            and array.ndim == 1
            and (count is None or len(array) == count)
            and flags.c_contiguous
            and (flags.writeable or not write)
        )
    except AttributeError:
        fits = False
    if not fits:
        _refuse(array, dtype, name, caller, what, count, write)
    return ffi.from_buffer(_types[name], array, write)
