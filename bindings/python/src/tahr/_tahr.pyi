# The extension that cffi builds: every function and type of the C headers, checked where it is called.
from typing import Any

ffi: Any
lib: Any
