# SPDX-License-Identifier: MIT
"""scikit-build-core, which is told to bring lcm-gen (it is part of PyPI's lcm) where the machine has none."""

import shutil
from typing import Any, Dict, List, Optional

from scikit_build_core import build
from scikit_build_core.build import *  # noqa: F403

Settings = Optional[Dict[str, Any]]


def _generator() -> List[str]:
    return [] if shutil.which("lcm-gen") else ["lcm>=1.5"]


def get_requires_for_build_wheel(config_settings: Settings = None) -> List[str]:
    return [*build.get_requires_for_build_wheel(config_settings), *_generator()]


def get_requires_for_build_editable(config_settings: Settings = None) -> List[str]:
    return [*build.get_requires_for_build_editable(config_settings), *_generator()]
