#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Proves that the source tree keeps to the layers of docs/architecture.md.

Usage: scripts/check_layers.py [--root FOLDER] [--no-compile]

Each rule is a function below that yields what breaks it; docs/architecture.md says why the rules are there. Needs
nothing but Python and, for the last rule, a C++ compiler (CXX, or g++).
"""
import argparse
import hashlib
import os
import pathlib
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

TABLE = "docs/architecture.md"
SOURCE_FOLDERS = ("src", "tests", "bench", "cmake", "scripts", ".ci")
# The only file outside app that may write to the terminal: it reports a bug and aborts.
MAY_PRINT = "src/core/check.cpp"

STD_HEADERS = set("""algorithm any array atomic barrier bit bitset charconv chrono codecvt compare complex concepts
condition_variable coroutine deque exception execution filesystem format forward_list fstream functional future
initializer_list iomanip ios iosfwd iostream istream iterator latch limits list locale map memory memory_resource mutex
new numbers numeric optional ostream queue random ranges ratio regex scoped_allocator semaphore set shared_mutex
source_location span sstream stack stdexcept stop_token streambuf string string_view strstream syncstream
system_error thread tuple type_traits typeindex typeinfo unordered_map unordered_set utility valarray variant vector
version cassert cctype cerrno cfenv cfloat cinttypes climits clocale cmath csetjmp csignal cstdarg cstddef cstdint
cstdio cstdlib cstring ctime cuchar cwchar cwctype""".split())

COMMENT_OR_LITERAL = re.compile(
    r"""(?P<comment>//(?:\\\n|[^\n])*|/\*.*?\*/)
      | R"(?P<delimiter>[^()\\\s"]*)\(.*?\)(?P=delimiter)"
      | "(?:\\.|[^"\\\n])*"
      | (?<![0-9A-Za-z_])'(?:\\.|[^'\\\n])+'""", re.DOTALL | re.VERBOSE)
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?P<open>[<"])(?P<path>[^>"]+)[>"]', re.MULTILINE)
PRINTING = re.compile(r"\bstd::(?:cout|cerr|clog)\b|\b(?:stdout|stderr)\b|\b(?:v?printf|puts|putchar|perror)\s*\(|\bspdlog\b")


class Include:
    def __init__(self, path, is_quoted, line):
        self.path, self.is_quoted, self.line = path, is_quoted, line


class SourceFile:
    """One C++ file: its text, includes and place among the modules."""

    def __init__(self, root, path):
        self.name = path.relative_to(root).as_posix()
        self.text = path.read_text(encoding="utf-8")
        parts = self.name.split("/")
        self.top = parts[0]                                  # src, tests, bench
        self.module = parts[1] if len(parts) > 2 else None   # the folder below it
        self.is_header = path.suffix == ".h"
        self.is_public_header = self.top == "src" and self.is_header and len(parts) == 3
        without_comments = blank(self.text, literals=False)
        self.includes = [Include(m["path"], m["open"] == '"', line_of(without_comments, m.start("path")))
                         for m in INCLUDE.finditer(without_comments)]


def blank(text, literals):
    """The text with comments, and if asked for string literals too, replaced by blanks; lines stay lines."""
    def replace(match):
        if match["comment"] is None and not literals:
            return match[0]
        return re.sub(r"[^\n]", " ", match[0])
    return COMMENT_OR_LITERAL.sub(replace, text)


def line_of(text, position):
    return text.count("\n", 0, position) + 1


def read_table(root):
    """{module: the modules it may include}, from the fenced block of the table. "everything" stands for all others."""
    text = (root / TABLE).read_text(encoding="utf-8")
    block = re.search(r"^```layers\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
    if not block:
        raise ValueError(f"{TABLE}: no block that begins with ```layers")
    table = {}
    first_line = line_of(text, block.start(1))
    for line, row in enumerate(block[1].splitlines(), first_line):
        match = re.fullmatch(r"(\w+) *:( [\w ]*?)?(?:  +.*)?", row)
        if not match:
            raise ValueError(f"{TABLE}:{line}: not a row of the form 'module : modules it may include   what it is'")
        uses = (match[2] or "").split()
        if uses == ["everything"]:
            uses = list(table)
        for used in uses:
            if used not in table:
                raise ValueError(f"{TABLE}:{line}: {match[1]} uses {used}, which is not a row above it")
        table[match[1]] = set(uses)
    return table


def module_folders(root):
    return sorted(p.name for p in (root / "src").iterdir() if p.is_dir() and any(f.is_file() for f in p.rglob("*")))


def modules_outside_the_table(root, table):
    for module in module_folders(root):
        if module not in table:
            yield f"src/{module}: has no row in {TABLE}"


def forbidden_includes(files, table):
    for file in files:
        if file.top != "src" or file.module not in table:
            continue
        for include in file.includes:
            target = include.path.split("/")[0]
            if not include.is_quoted:
                continue
            if target not in table or "/" not in include.path:
                yield f'{file.name}:{include.line}: "{include.path}" must be written as "module/file.h"'
            elif target == "app" and file.module != "app":
                yield f'{file.name}:{include.line}: includes "{include.path}", but nothing includes app'
            elif target != file.module and target not in table[file.module]:
                yield f'{file.name}:{include.line}: {file.module} may not include "{include.path}"; see {TABLE}'


def foreign_private_headers(root, files):
    """Subfolders of a module are private to it and to its own tests and benches."""
    for file in files:
        for include in file.includes:
            parts = include.path.split("/")
            if include.is_quoted and len(parts) > 2 and (root / "src" / include.path).is_file() and parts[0] != file.module:
                yield f'{file.name}:{include.line}: "{include.path}" is private to {parts[0]}'


def third_party_in_public_headers(files):
    for file in files:
        if not file.is_public_header:
            continue
        for include in file.includes:
            if not include.is_quoted and include.path not in STD_HEADERS:
                yield (f"{file.name}:{include.line}: a public header may not include <{include.path}>; "
                       "hide the library in a .cpp")


def printing_outside_app(files):
    for file in files:
        if file.top != "src" or file.module == "app" or file.name == MAY_PRINT:
            continue
        code = blank(file.text, literals=True)
        for match in PRINTING.finditer(code):
            yield f"{file.name}:{line_of(code, match.start())}: only app prints ({match[0].rstrip('( ')})"
        for include in file.includes:
            if include.path == "iostream":
                yield f"{file.name}:{include.line}: only app prints (<iostream>)"


def missing_license_lines(root):
    for top in SOURCE_FOLDERS:
        for path in sorted((root / top).rglob("*")):
            is_source = path.suffix in (".h", ".cpp", ".cmake", ".py", ".sh") or path.parent.name == ".ci"
            if path.is_file() and is_source:
                head = path.read_text(encoding="utf-8").splitlines()[:3]
                if not any("SPDX-License-Identifier: Apache-2.0" in line for line in head):
                    yield f"{path.relative_to(root).as_posix()}:1: no SPDX-License-Identifier line at the top"


def headers_that_need_others(root, files):
    """Compiles each header of src/ by itself. What compiled once is not compiled again until it, or a header that it
    includes, changes: build/check_layers holds an empty file for each digest that passed."""
    compiler = os.environ.get("CXX", "g++").split()
    version = subprocess.run([*compiler, "--version"], capture_output=True, check=True).stdout
    cache = root / "build" / "check_layers"
    cache.mkdir(parents=True, exist_ok=True)
    headers = {f.name.removeprefix("src/"): f for f in files if f.top == "src" and f.is_header}

    def with_all_it_includes(header, seen):
        if header.name not in seen:
            seen[header.name] = header.text
            for include in header.includes:
                if include.path in headers:
                    with_all_it_includes(headers[include.path], seen)
        return seen

    def problem(header):
        # Public headers see the standard library and src/ alone; private ones also where Debian puts GDAL and OpenCV.
        flags = ["-std=c++20", "-fsyntax-only", "-I" + str(root / "src")]
        if not header.is_public_header:
            flags += ["-isystem", "/usr/include/gdal", "-isystem", "/usr/include/opencv4"]
        content = sorted(with_all_it_includes(header, {}).items())
        passed = cache / hashlib.sha256(repr((version, flags, content)).encode()).hexdigest()
        if passed.exists():
            return None
        program = f'#include "{header.name.removeprefix("src/")}"\n'
        run = subprocess.run([*compiler, *flags, "-x", "c++", "-"], input=program, capture_output=True, text=True)
        if run.returncode == 0:
            passed.touch()
            return None
        first_error = next((line for line in run.stderr.splitlines() if "error:" in line), run.stderr.strip())
        return f"{header.name}:1: does not compile by itself: {first_error}"

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        yield from filter(None, pool.map(problem, headers.values()))


def violations(root, compile_headers=True):
    table = read_table(root)
    paths = sorted(p for top in ("src", "tests", "bench") for p in (root / top).rglob("*") if p.suffix in (".h", ".cpp"))
    files = [SourceFile(root, path) for path in paths]
    yield from modules_outside_the_table(root, table)
    yield from forbidden_includes(files, table)
    yield from foreign_private_headers(root, files)
    yield from third_party_in_public_headers(files)
    yield from printing_outside_app(files)
    yield from missing_license_lines(root)
    if compile_headers:
        yield from headers_that_need_others(root, files)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent)
    parser.add_argument("--no-compile", action="store_true", help="leave out the compilation of each header")
    arguments = parser.parse_args()
    try:
        found = list(violations(arguments.root.resolve(), not arguments.no_compile))
    except ValueError as error:
        found = [str(error)]
    print("\n".join(found) if found else "Layers: every rule holds.")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
