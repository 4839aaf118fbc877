#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Relievo authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fails when build, tests or scripts use what toolchain/setup would not install on an empty Debian 12.

    check_setup.py PRESET...     looks at what was built in build/PRESET

That everything is there proves nothing where much came by hand. So this looks at what was used:
  - the headers in ninja's record, and every file of the system that a command of the build names;
  - the libraries that the built programs load;
  - what the tests opened and ran (build/PRESET.opened, written by strace for toolchain/test);
  - the programs that the scripts call.
dpkg says which package owns it, apt which packages an empty system would have.
tests/toolchain/check_setup_test.py plants one violation of each kind.
"""
import functools
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
SETS = ("", "test", "tidy", "arm64", "vm")        # what toolchain/setup takes; the script of a name calls it with that
PRESUPPOSED = ("apt", "git", "ca-certificates")   # the README: a Debian with nothing installed but git
# Not ours to install: what the machine chose among equals, and what is used where it is there and not missed where it is
# not: OpenMP by TBB, node and npm by the tests, sudo by toolchain/setup. It brings what it needs.
CHOSEN = re.compile(r"^/etc/alternatives/|/egl_vendor\.d/|/bfd-plugins/|/libnss_|/libiomp5\.so|/bin/(node|npm|sudo)$")
# Read because it lies where all that lies there is read; ldd asks every loader that there is.
LIES_THERE = re.compile(r"^/etc/|/fontconfig/conf\.avail/|/poppler/nameToUnicode/|\.pth$|/ld-linux[^/]*$")
FONT = re.compile(r"/fonts/.*\.(otf|tt[cf]|pf[ab]|t1)$")
# A word in command position, and what may stand between it and the separator before it. After = a bracket opens a list.
COMMAND = re.compile(r'(?:^(?:\s*[^()\s]+\))?+|[|&;!]|\{\s|(?<!=)\()[ \t]*'
                     r'(?:(?:then|do|else|if|elif|while|until|exec|nice|xargs|env|\w+=[^\s(]*|check ""|quietly(?: \S+\.log| "")?)\s+)*'
                     r"([a-z][\w.+-]*)(?![^\s;|&)])", re.MULTILINE)


def output(*command, may_fail=False):
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", env=os.environ | {"LC_ALL": "C"})
    if done.returncode and not may_fail:
        hint = " (does apt know any package? apt-get update)" if command[0] == "apt-get" else ""
        sys.exit(f"set-up: {command[0]} failed: {done.stderr.strip()[-300:]}{hint}")
    return done.stdout


def would_install(packages):
    """Every package of a bare Debian on which these were installed."""
    native = f"?architecture({output('dpkg', '--print-architecture').strip()})"
    said = output("apt-get", "--print-uris", "-o", "Dir::State::status=/dev/null", "install", "--no-install-recommends",
                  f"?and(?essential,{native})", f"?and(?priority(required),{native})", *PRESUPPOSED, *packages)
    return set(re.search(r"^The following NEW packages will be installed:\n((?: .*\n)*)", said, re.MULTILINE)[1].split())


def names(path):
    """The path and, link by link, every other name of the file on the way to its own."""
    found = [os.path.normpath(path)]
    for name in found:
        parts = name.split("/")
        for n in range(2, len(parts) + 1):
            link = "/".join(parts[:n])
            if os.path.islink(link) and len(found) < 40:   # a link may lead to itself
                target = os.path.join(os.path.dirname(link), os.readlink(link))
                found.append(os.path.normpath("/".join([target, *parts[n:]])))
                break
    return found


def owners(paths):
    """path: the packages it belongs to. Some packages still call /lib what has become /usr/lib."""
    asked = sorted({name for path in paths for name in (path, path.removeprefix("/usr"))})
    known = {}
    for n in range(0, len(asked), 5000):   # no command line is endless
        for line in output("dpkg-query", "-S", *asked[n:n + 5000], may_fail=True).splitlines():
            packages, _, path = line.partition(": ")
            if not packages.startswith("diversion by "):
                known.setdefault(path, set()).update(re.sub(r":\w+", "", packages).split(", "))
    return {path: known.get(path, set()) | known.get(path.removeprefix("/usr"), set()) for path in paths}


def with_what_they_need(packages):
    """These and all installed ones that they depend on."""
    needs = {}
    for line in output("dpkg-query", "-W", "-f", "${Package}\t${Pre-Depends}, ${Depends}\n").splitlines():
        package, _, fields = line.partition("\t")
        needs.setdefault(package, set()).update(re.findall(r"(?:^|[,|]) *([a-z0-9][a-z0-9.+-]+)", fields))
    found, new = set(), set(packages)
    while new:
        found |= new
        new = set().union(*(needs.get(package, ()) for package in new)) - found
    return found


def asked_for(font):
    """Whether ui/ names the family. Any other font is fontconfig's choice, for a letter that ours do not have."""
    ours = " ".join(path.read_text() for path in (ROOT / "ui").rglob("*.h"))
    families = re.split(r"[,\n]", output("fc-query", "-f", "%{family}\n", font))
    return any(re.search(rf'("|, ){re.escape(family)}[",]', ours) for family in families if family)


def problems(used, installed, setup):
    """used: path and how it is used; setup: the command that installs. A line for every package that is lacking."""
    ways = {path: names(path) for path in used}
    owner = owners({name for way in ways.values() for name in way})
    chosen = {path for path, way in ways.items() if any(map(CHOSEN.search, way))}
    accepted = installed | with_what_they_need({p for path in chosen for name in ways[path] for p in owner[name]})
    lacking = {}
    for path, way in ways.items():
        if path in chosen or any(map(LIES_THERE.search, way)):
            continue
        if way[-1].startswith(("/usr/local/", "/opt/")) and not owner[way[-1]]:
            yield f"{path} ({used[path]}) belongs to no package of Debian: do without it"
        for packages in filter(None, map(owner.get, way)):
            if not packages & accepted and not (FONT.search(path) and not asked_for(path)):
                lacking.setdefault(min(packages), {})[path] = used[path]
    for package, files in lacking.items():
        path, how = next(iter(files.items()))
        more = f"; {len(files) - 1} more of its files" if len(files) > 1 else ""
        yield (f"{path} ({how}{more}) belongs to {package}, which {setup} does not install: "
               f"add {package} to toolchain/setup or do without")


def headers(build):
    how = ""
    for line in output("ninja", "-C", build, "-t", "deps").splitlines():
        if line.startswith("    /"):
            yield line.strip(), how
        elif not line.startswith(" "):
            how = "included by " + re.sub(r"CMakeFiles/[^/]+\.dir/|\.o: .*", "", line)


def commands(build):
    return output("ninja", "-C", build, "-t", "commands", "all", "benches").splitlines()


def made(command):
    return "".join(re.findall(r" -o (\S+)", command)[:1])


def named(lines):
    """The files of the system that the commands of a build name."""
    for line in lines:
        for word in line.split():
            if word.startswith("-l"):
                found = [output("g++", f"-print-file-name=lib{word[2:]}{end}").strip() for end in (".so", ".a")]
                word = next(filter(os.path.isabs, found), word)
            if os.path.isabs(word) and os.path.isfile(word):
                yield word, f"to make {made(line)}".rstrip()


def loaded(build, lines):
    programs = {path for path in (pathlib.Path(build, made(line)) for line in lines if made(line))
                if path.suffix == "" and path.is_file() and os.access(path, os.X_OK)}
    for program in sorted(programs):
        for path in re.findall(r"(/\S+) \(0x", output("ldd", program, may_fail=True)):
            yield path, f"loaded by {program.name}"


def opened(record):
    for path in record.read_text(errors="replace").splitlines():
        if os.path.isfile(path):
            yield path, "opened or run by a test"


def called(script, text):
    text = re.sub(r"(^|\s)#.*", r"\1", text, flags=re.MULTILINE)
    text = re.sub(r"<<(\w+)\n.*?\n\1\n", "\n", text, flags=re.DOTALL)
    text = re.sub(r"'[^'\n]*'", "''", text)
    text = re.sub(r'"[^"\n]*"', lambda quoted: quoted[0] if "$(" in quoted[0] else '""', text)
    for word in sorted(set(COMMAND.findall(text)) - set(re.findall(r"^(\w+)\(\)", text, re.MULTILINE))):
        # Debian's before another of its name that the machine may prefer.
        path = shutil.which(word, path="/usr/bin:/usr/sbin:/bin:/sbin") or shutil.which(word)
        if path:
            yield path, f"called by {script}"


def main(presets):
    used = {what: {} for what in SETS}
    for preset in presets:
        build, record = ROOT / "build" / preset, ROOT / "build" / f"{preset}.opened"
        lines = commands(build)
        parts = {"headers": dict(headers(build)), "files that the build names": dict(named(lines)),
                 "libraries that are loaded": dict(loaded(build, lines))}
        for part in parts.values():
            used[""].update(part)
        if record.exists():
            parts["files that the tests opened"] = dict(opened(record))
            used["test"].update(parts["files that the tests opened"])
        for part, files in parts.items():
            if not files:
                yield f"{preset}: no {part}: nothing was built or recorded"
        print(f"set-up: {preset}: " + ", ".join(f"{len(files)} {part}" for part, files in parts.items()))
    for script in (ROOT / ".ci/run", ROOT / "tests/vm/make_guest", *sorted((ROOT / "toolchain").iterdir())):
        if script.is_file() and script.read_text().startswith("#!/usr/bin/env bash"):
            text = script.read_text()
            own = re.search(r"^toolchain/setup (\w+)", text, re.MULTILINE)  # what it installs itself
            what = own[1] if own else next((what for what in SETS if what in (script.name, script.parent.name)), "")
            used[what].update(called(script.relative_to(ROOT), text))
    would = functools.cache(lambda what: would_install(output(ROOT / "toolchain/setup", "list", what).split()))
    for what in SETS:
        if any(problems(used[what], would(""), "")):   # seldom: apt takes its seconds
            yield from problems(used[what], would(what), f"toolchain/setup {what}".strip())


if __name__ == "__main__":
    found = list(main(sys.argv[1:]))
    print("\n".join(found) or "set-up: all of it comes with toolchain/setup")
    sys.exit(bool(found))
