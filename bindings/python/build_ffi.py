# SPDX-License-Identifier: MIT
"""Writes what the package is made of from the public headers, so that nothing is said twice.

Run by CMake. Into the folder --out go
    _tahr.c        the extension: every function of the headers that are built in, by cffi
    _constants.py  every TAHR_X as X
    _errors.py     an exception for each status
    _records.py    every struct that Python users see, with the headers' own comments as documentation
"""

import argparse
import pathlib
import re
import subprocess
import textwrap

import cffi

# Structs that are NumPy dtypes or have a class of their own: C name -> Python name.
RECORDS = {
    "tahr_pose": "Pose",
    "tahr_bounds": "Bounds",
    "tahr_shape": "Shape",
    "tahr_floor": "Floor",
    "tahr_base": "Base",
    "tahr_config": "ConfigFields",
    "tahr_state": "StateFields",
    "tahr_input": "Input",
    "tahr_report": "ReportFields",
    "tahr_body_desc": "BodyFields",
    "tahr_body_pose": "BodyPose",
    "tahr_body_motion": "BodyMotionFields",
    "tahr_sweep": "SweepFields",
    "tahr_contact_query": "ContactQueryFields",
    "tahr_ray": "RayFields",
    "tahr_fluid_query": "FluidQueryFields",
    "tahr_hit": "Hit",
    "tahr_contact": "Contact",
    "tahr_fluid": "FluidFields",
    "tahr_crowd_counts": "CrowdCounts",
}
DTYPES = ["tahr_event", "tahr_decision", "tahr_query_record", "tahr_member", "tahr_delay"]

# Functions of Python that C calls.
CALLBACKS = """
extern "Python" {
    tahr_status python_sweep(void *, const tahr_sweep *, tahr_hit *);
    tahr_status python_contacts(void *, const tahr_contact_query *, tahr_contact *, uint32_t, uint32_t *);
    tahr_status python_ray(void *, const tahr_ray *, tahr_hit *);
    tahr_status python_sensors(void *, const tahr_sweep *, tahr_hit *, uint32_t, uint32_t *);
    tahr_status python_body(void *, uint32_t, tahr_body_motion *);
    tahr_status python_fluid(void *, const tahr_fluid_query *, tahr_fluid *);
    tahr_status python_custom_mode(void *, tahr_step *, double, tahr_custom_next *);
    void python_line(void *, int32_t, const char *);
}
"""

# Whoever catches Python's own exceptions catches these too.
BUILTIN = {
    "argument": "ValueError",
    "null": "ValueError",
    "geometry": "ValueError",
    "struct_size": "ValueError",
    "unsupported": "NotImplementedError",
    "memory": "MemoryError",
    "backend": "RuntimeError",
    "reentrant": "RuntimeError",
    "abi": "ImportError",
    "float_mode": "RuntimeError",
    "not_found": "LookupError",
    "file": "OSError",
    "timeout": "TimeoutError",
}

HEAD = "# Made from the headers by build_ffi.py.\n"


def preprocess(options: argparse.Namespace, glue: pathlib.Path, *flags: str) -> str:
    """What the compiler's preprocessor makes of the headers: libc's are empty here, compilers have no attributes."""
    fake = options.out / "no_libc"
    fake.mkdir(parents=True, exist_ok=True)
    for name in ("stddef.h", "stdint.h"):
        (fake / name).write_text("")
    defines = [f"-D{name}" for name in options.define]
    command = [options.cc, "-E", "-P", "-x", "c", *flags, "-U__GNUC__", f"-I{fake}", f"-I{options.include}", *defines]
    return subprocess.run([*command, str(glue)], check=True, capture_output=True, text=True).stdout


def macros(definitions: str) -> "list[str]":
    """TAHR_X of #define TAHR_X value, which the preprocessor swallows; functions, switches and guards have none."""
    names = re.findall(r"^#define (TAHR_[A-Z0-9_]+) +[^ \n]", definitions, re.M)
    return sorted(name for name in names if name != "TAHR_API" and not name.startswith("TAHR_HAVE_"))


def enumerators(declarations: str) -> "list[str]":
    bodies = re.findall(r"\benum\s*\{(.*?)\}", declarations, re.S)
    return [name for body in bodies for name in re.findall(r"\b(TAHR_[A-Z0-9_]+)\b\s*=", body)]


def write_constants(names: "list[str]") -> str:
    short = [name[len("TAHR_") :] for name in names]
    exported = ", ".join(f'"{name}"' for name in short)
    return (
        HEAD
        + '"""Every constant of the C headers, without its TAHR_."""\n'
        + "from typing import Final\n\nfrom ._tahr import lib\n\n"
        + "\n".join(f"{name}: Final[int] = lib.TAHR_{name}" for name in short)
        + "\n\n__all__ = [\n"
        + textwrap.fill(exported, 110, initial_indent="    ", subsequent_indent="    ")
        + ",\n]\n"
    )


def write_errors(text: str) -> str:
    table = re.findall(r'X\(TAHR_E_\w+, (-\d+), "(\w+)", "([^"]+)"\)', text)
    lines = [HEAD + '"""An exception for each status of the library, named after it."""']
    lines += ["import builtins", "from typing import Dict, Type", "", "from ._error import Error", "", ""]
    entries, titles = [], []
    for number, name, message in table:
        title = "".join(part.capitalize() for part in name.split("_")) + "Error"
        base = f", builtins.{BUILTIN[name]}" if name in BUILTIN else ""
        lines += [f"class {title}(Error{base}):", f'    """{message}"""', ""]
        lines += [f"    status = {number}", "", ""]
        entries.append(f"    {number}: {title},")
        titles.append(f'    "{title}",')
    lines += ["BY_STATUS: Dict[int, Type[Error]] = {", *entries, "}", ""]
    return "\n".join([*lines, "__all__ = [", *titles, "]", ""])


def clean(comment: str) -> str:
    words = re.sub(r"^\s*\*", "", comment, flags=re.M).split()
    return " ".join(words).replace("\\", "\\\\").replace('"', "'")


def field_documents(body: str) -> "dict[str, str]":
    """Of each field the comment beside it, or, where there is none, the one before it."""
    fields: "dict[str, str]" = {}
    before, last = "", []
    for gap, comment, declaration in re.findall(r"(\s*)(?:/\*(.*?)\*/|([^;/]+;))", body, re.S):
        if declaration:
            last = re.findall(r"(\w+)\s*[,;]", re.sub(r"\[[^\]]*\]", "", declaration))
            fields.update({field: before for field in last})
            before = ""
        elif last and "\n" not in gap:
            fields.update({field: clean(comment) for field in last})
        else:
            before = clean(comment)
    return fields


def struct_documents(text: str) -> "dict[str, tuple[str, dict[str, str]]]":
    """Struct name -> the comment before it, and the documents of its fields."""
    pattern = r"(?:/\*((?:(?!\*/).)*)\*/\s*)?typedef struct (tahr_\w+) \{\n(.*?)\n\} \2;"
    found = re.findall(pattern, text, re.S)
    return {name: (clean(about), field_documents(body)) for about, name, body in found}


def descriptor(field: "cffi.FFI.CType", document: str, fixed: bool) -> str:
    """The descriptor of _record.py for a field of this type; '' for pointers, which Python sets by itself."""
    kind, name = field.kind, field.cname
    if kind == "struct":
        if name in ("tahr_vec3", "tahr_quat"):
            return f'Vector({3 if name == "tahr_vec3" else 4}, "{document}")'
        return f'Nested({RECORDS[name]}, "{document}")'
    if kind == "array":
        return f'Integers({field.length}, "{document}")'
    if kind == "primitive":
        return f'{"Real" if name == "double" else "Fixed" if fixed else "Integer"}("{document}")'
    return ""


def write_records(ffi: cffi.FFI, text: str) -> str:
    documents = struct_documents(text)
    lines = [HEAD + '"""The structs of the C headers, with the headers\' own comments."""']
    lines += ["from ._record import Fixed, Integer, Integers, Nested, Plain, Real, Record, Vector", "", ""]
    for name, title in RECORDS.items():
        about, comments = documents[name]
        fields = [(field, info.type) for field, info in ffi.typeof(name).fields]
        base = "Record" if any(kind.kind == "pointer" for _, kind in fields) else "Plain"
        about = textwrap.fill(about or title, 108, subsequent_indent="    ")
        lines += [f"class {title}({base}):", f'    """{about}"""', "", "    __slots__ = ()", f'    ctype = "{name}"']
        for field, kind in fields:
            # What says how long an array behind a pointer is, is not for everybody to change.
            fixed = base == "Record" and re.search("_count$|_capacity$|^rows$|^columns$", field) is not None
            made = descriptor(kind, comments.get(field, ""), fixed)
            if made and field != "struct_size" and not field.startswith("reserved"):
                lines.append(f"    {field} = {made}")
        lines += ["", ""]
    return "\n".join(lines)


def write_layout(ffi: cffi.FFI) -> str:
    """The table of glue_layout: what the C compiler itself says of each field."""
    rows = []
    for name in [*RECORDS, *DTYPES, "tahr_vec3", "tahr_quat"]:
        rows.append(f'{{"{name}", 0, sizeof({name}), 0}},')
        for field, _ in ffi.typeof(name).fields:
            rows.append(f'{{"{name}", "{field}", sizeof((({name} *)0)->{field}), offsetof({name}, {field})}},')
    body = "\n    ".join(rows)
    return (
        f"const glue_field glue_layout[] = {{\n    {body}\n}};\n"
        "const size_t glue_layout_count = sizeof glue_layout / sizeof *glue_layout;\n"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description="Writes the generated parts of the package.")
    parser.add_argument("--cc", required=True, help="the C compiler")
    parser.add_argument("--include", required=True, help="folder of tahr/tahr.h")
    parser.add_argument("--define", action="append", default=[], help="TAHR_HAVE_X of what is built in")
    parser.add_argument("--out", required=True, type=pathlib.Path)
    options = parser.parse_args()
    here = pathlib.Path(__file__).parent
    options.out.mkdir(parents=True, exist_ok=True)

    glue = here / "glue/glue.h"
    declarations = preprocess(options, glue)
    defined = macros(preprocess(options, glue, "-dM"))
    text = "\n".join(path.read_text() for path in sorted(pathlib.Path(options.include, "tahr").glob("*.h")))
    ffi = cffi.FFI()
    ffi.cdef(declarations + "".join(f"#define {name} ...\n" for name in defined) + CALLBACKS)
    ffi.set_source("tahr._tahr", '#include "glue.h"\n' + write_layout(ffi))
    ffi.emit_c_code(str(options.out / "_tahr.c"))
    (options.out / "_constants.py").write_text(write_constants([*enumerators(declarations), *defined]))
    (options.out / "_errors.py").write_text(write_errors(text))
    (options.out / "_records.py").write_text(write_records(ffi, text))


if __name__ == "__main__":
    main()
