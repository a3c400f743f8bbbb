#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The systemd unit of `skysweep watch`: its command line is one the program takes, systemd accepts it, and it is locked
in. Usage: service_test.py PROGRAM"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
UNIT = ROOT / "config" / "skysweep-watch@.service"
PROGRAM = pathlib.Path()
SECTIONS = ("Unit", "Service", "Install")


def settings():
    """{section: {key: values in order}}"""
    found, section = {}, None
    for line in UNIT.read_text(encoding="utf-8").splitlines():
        if line.startswith("["):
            section = found.setdefault(line.strip("[]"), {})
        elif line and not line.startswith("#"):
            key, value = line.split("=", 1)
            section.setdefault(key, []).append(value)
    return found


class ServiceTest(unittest.TestCase):
    def test_the_unit_is_made_of_sections_that_systemd_knows(self):
        self.assertEqual(tuple(settings()), SECTIONS)

    def test_it_may_write_the_maps_and_nothing_else(self):
        service = settings()["Service"]
        self.assertEqual(service["ProtectSystem"], ["strict"])
        self.assertEqual(service["ReadWritePaths"], ["/srv/skysweep/%i/maps"])
        self.assertEqual(service["ReadOnlyPaths"], ["/srv/skysweep/%i/incoming"])
        self.assertEqual(service["NoNewPrivileges"], ["yes"])
        self.assertEqual(service["CapabilityBoundingSet"], [""])
        self.assertNotIn(service["User"], (["root"], [""]))

    def test_the_program_takes_its_command_line(self):
        _, command, *arguments = settings()["Service"]["ExecStart"][0].split()
        self.assertEqual(command, "watch")
        offered = subprocess.run([PROGRAM, "watch", "--help"], capture_output=True, text=True, check=True).stdout
        for argument in arguments:
            if argument.startswith("--"):
                self.assertIn(argument, offered)
        self.assertIn("-HUP", settings()["Service"]["ExecReload"][0])

    @unittest.skipUnless(shutil.which("systemd-analyze"), "systemd-analyze is not installed")
    def test_systemd_accepts_it(self):
        with tempfile.TemporaryDirectory() as folder:
            unit = pathlib.Path(folder) / "skysweep-watch@test.service"
            unit.write_text(UNIT.read_text(encoding="utf-8").replace("/usr/bin/skysweep", str(PROGRAM)), encoding="utf-8")
            done = subprocess.run(["systemd-analyze", "verify", unit], capture_output=True, text=True, check=False)
            about_it = [line for line in (done.stdout + done.stderr).splitlines() if "skysweep" in line]
            self.assertEqual(about_it, [])
            self.assertEqual(done.returncode, 0, done.stderr)

    @unittest.skipUnless(shutil.which("systemd-analyze"), "systemd-analyze is not installed")
    def test_systemd_finds_it_little_exposed(self):
        # 0 is a unit that can do nothing, 10 one without any bounds.
        done = subprocess.run(["systemd-analyze", "security", "--offline=true", "--threshold=20", UNIT],
                              capture_output=True, text=True, check=False)
        if "unrecognized option" in done.stderr:
            self.skipTest("this systemd-analyze judges no files")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    PROGRAM = pathlib.Path(sys.argv.pop()).resolve()
    unittest.main()
