# Bullet: Debian's libbullet-dev.
if(PkgConfig_FOUND)
    pkg_check_modules(bullet QUIET IMPORTED_TARGET bullet)
endif()
if(bullet_FOUND)
    set(example_libraries PkgConfig::bullet)
else()
    set(example_left_out "pkg-config does not find bullet")
endif()
