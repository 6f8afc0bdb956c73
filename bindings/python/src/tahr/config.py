# SPDX-License-Identifier: MIT
"""The settings of a character, and their presets."""

from typing import Any, Union

from ._constants import PRESET_PLATFORMER, PRESET_PRECISE, PRESET_UNREAL
from ._errors import ArgumentError
from ._records import ConfigFields
from ._status import check
from ._tahr import ffi, lib

_PRESETS = {"precise": PRESET_PRECISE, "unreal": PRESET_UNREAL, "platformer": PRESET_PLATFORMER}


class Config(ConfigFields):
    """A preset, "precise", "unreal" or "platformer", with the fields that are given set to something else.

    Fields are those of the C struct, in metres, seconds and radians; help(tahr.Config) lists them with their defaults.
    Raises ArgumentError, naming the field, where one is out of its range or unknown.
    """

    __slots__ = ()

    def __init__(self, preset: Union[str, int] = "precise", **fields: Any) -> None:
        super().__init__()
        number = _PRESETS.get(preset) if isinstance(preset, str) else preset
        if number not in _PRESETS.values():
            raise ArgumentError(f"Config: preset is {preset!r}, expected one of {', '.join(_PRESETS)}")
        check(lib.tahr_config_init(self._c, self.dtype.itemsize, number), "Config")
        self.update(**fields)
        self.check()

    def check(self) -> None:
        """Raises ArgumentError, naming the first field that is out of its range."""
        field = ffi.new("const char **")
        lib.glue_forget()
        status = lib.tahr_config_check(self._c, field)
        if status < 0 and field[0]:
            name = ffi.string(field[0]).decode()
            value: Any = self
            for part in name.split("."):
                value = getattr(value, part, None)
            raise ArgumentError(f"Config: {name} is {value!r}, out of its range; help(tahr.Config) lists the ranges")
        check(status, "Config")

    def scaled(self, factor: float) -> "Config":
        """A copy for a character `factor` times as large that moves alike. factor > 0, finite."""
        other = self.copy()
        lib.glue_forget()
        if lib.tahr_config_scale(other._c, factor) < 0:
            raise ArgumentError(
                f"Config.scaled: factor is {factor!r}, expected a finite number above 0 "
                "that leaves every field in its range"
            )
        return other
