# SPDX-License-Identifier: MIT
"""What all exceptions of the package have in common, and those that only Python needs."""

from typing import Optional


class Error(Exception):
    """Something was refused; nothing has changed. The text names the argument and what was expected of it.

    status: the C library's status, a negative number; None where the C library was not asked.
    """

    status: Optional[int] = None


class ClosedError(Error, ValueError):
    """The world, mover or crowd was closed before."""


class InUseError(Error, RuntimeError):
    """A world cannot be closed while movers or crowds of it are open, nor recorded twice at once."""
