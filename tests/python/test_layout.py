# SPDX-License-Identifier: MIT
"""Arrays are the C structs, byte for byte."""

import numpy as np
import pytest

import tahr
from tahr import _layout
from tahr._tahr import ffi, lib


def test_state_is_512_bytes_and_event_and_input_as_in_c():
    assert tahr.STATE.itemsize == 512
    for name in ("state", "input", "report", "event", "member", "delay", "hit", "contact", "body_pose"):
        assert getattr(tahr, name.upper()).itemsize == ffi.sizeof(f"tahr_{name}")


def test_every_field_lies_where_c_has_it():
    names = {ffi.string(lib.glue_layout[i].type).decode() for i in range(lib.glue_layout_count)}
    assert {"tahr_state", "tahr_input", "tahr_report", "tahr_event", "tahr_member", "tahr_delay"} <= names
    state = np.zeros(2, tahr.STATE)
    state["velocity"][1] = (1, 2, 3)
    state["floor"]["distance"][1] = 0.25
    pointer = ffi.from_buffer("tahr_state[]", state)
    assert (pointer[1].velocity.x, pointer[1].velocity.y, pointer[1].velocity.z) == (1, 2, 3)
    assert pointer[1].floor.distance == 0.25


def test_a_dtype_that_differs_from_c_fails_the_import_with_both_numbers(monkeypatch):
    right = _layout.dtype_of("tahr_state")
    shifted = np.dtype(
        {
            "names": list(right.names),
            "formats": [right.fields[name][0] for name in right.names],
            "offsets": [right.fields[name][1] + (8 if name == "touched" else 0) for name in right.names],
            "itemsize": right.itemsize,
        }
    )
    monkeypatch.setitem(_layout._made, "tahr_state", shifted)
    with pytest.raises(
        ImportError, match=r"tahr_state\.touched has \(size, offset\) \(32, \d+\), the C library's \(32, \d+\)"
    ):
        _layout.check_layout()
    monkeypatch.setitem(_layout._made, "tahr_state", right)
    _layout.check_layout()


def test_fields_have_the_headers_comments():
    assert "distance kept from everything that blocks" in tahr.Config.skin.__doc__
    assert "rollback" in tahr.State.__mro__[1].__doc__ or "memcmp" in tahr.State.__mro__[1].__doc__
    assert "m/s" in tahr.Config.max_speed.__doc__


def test_every_status_of_c_has_an_exception_of_its_name():
    negative = {name: getattr(tahr, name) for name in tahr.__all__ if name.startswith("E_")}
    assert len(negative) >= 12
    for name, number in negative.items():
        title = "".join(part.capitalize() for part in name[2:].split("_")) + "Error"
        assert issubclass(getattr(tahr, title), tahr.Error)
        assert getattr(tahr, title).status == number
        assert tahr.status_name(number) == name[2:].lower()
