# SPDX-License-Identifier: MIT
"""NumPy dtypes laid out exactly as the C structs: vectors are arrays of 3, quaternions of 4 (x, y, z, w)."""

from typing import Any, Dict, Mapping, Tuple

import numpy as np

from ._tahr import ffi, lib

DType = np.dtype[Any]

_NUMBERS = {"double": "f8", "uint64_t": "u8", "uint32_t": "u4", "int32_t": "i4", "uint8_t": "u1"}
_VECTORS = {"tahr_vec3": 3, "tahr_quat": 4}
_made: Dict[str, DType] = {}


def _format_of(ctype: Any) -> Any:
    if ctype.kind == "array":
        return (_format_of(ctype.item), (ctype.length,))
    if ctype.kind == "pointer":
        return np.dtype(np.uintp)
    if ctype.kind == "primitive":
        return np.dtype(_NUMBERS[ctype.cname])
    name = ctype.cname.replace("struct ", "")
    if name in _VECTORS:
        return (np.dtype("f8"), (_VECTORS[name],))
    return dtype_of(name)


def dtype_of(name: str) -> DType:
    """The dtype of the C struct `name`, with its field names, offsets and size. Pointers are unsigned integers."""
    if name not in _made:
        fields = ffi.typeof(name).fields
        _made[name] = np.dtype(
            {
                "names": [field for field, _ in fields],
                "formats": [_format_of(info.type) for _, info in fields],
                "offsets": [info.offset for _, info in fields],
                "itemsize": ffi.sizeof(name),
            }
        )
    return _made[name]


def _measures(dtype: DType) -> Dict[str, Tuple[int, int]]:
    """Field -> (size, offset); the empty name is the whole."""
    fields: Mapping[str, Any] = dtype.fields or {}
    return {"": (dtype.itemsize, 0), **{name: (info[0].itemsize, info[1]) for name, info in fields.items()}}


def check_layout() -> None:
    """Compares every dtype with what the C compiler said of the structs. Raises ImportError at the first difference."""
    for i in range(lib.glue_layout_count):
        row = lib.glue_layout[i]
        name = ffi.string(row.type).decode()
        if name in _VECTORS:
            continue
        field = ffi.string(row.field).decode() if row.field else ""
        expected = (row.size, row.offset)
        found = _measures(dtype_of(name)).get(field)
        if found != expected:
            what = f"{name}.{field}" if field else name
            raise ImportError(
                f"tahr: NumPy's {what} has (size, offset) {found}, the C library's {expected}: "
                "this package and its C library do not belong together, install it anew"
            )
