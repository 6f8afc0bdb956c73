# SPDX-License-Identifier: MIT
"""From a status of the C library to an exception."""

import re
from typing import Dict, Type

from ._error import ClosedError, Error, InUseError
from ._errors import BY_STATUS
from ._tahr import ffi, lib

_CLASSES: Dict[int, Type[Error]] = {**BY_STATUS, lib.GLUE_CLOSED: ClosedError, lib.GLUE_IN_USE: InUseError}


def error_of(status: int, caller: str) -> Error:
    """The exception for a negative status: what the library just said on this thread, or what the status means."""
    said = ffi.string(lib.glue_message()).decode("utf-8", "replace")
    if not said and status in BY_STATUS:
        said = ffi.string(lib.tahr_status_message(status)).decode()
    text = re.sub(r"\btahr_\w+: ", "", said)  # functions of C, which nobody called here
    error = _CLASSES.get(status, Error)(f"{caller}: {text}")
    error.status = status
    return error


def check(status: int, caller: str) -> int:
    """The status, if it is none of an error."""
    if status < 0:
        raise error_of(status, caller)
    return status


def status_name(status: int) -> str:
    """The short name of a status: "ok", "stuck"; "?" for a number that is none."""
    return str(ffi.string(lib.tahr_status_name(status)).decode())
