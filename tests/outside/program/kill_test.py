"""An answer is the old one or the new one, whole, wherever writing it fails or is killed."""
import hashlib
import itertools
import os
import shutil
import signal
import subprocess

from in_folder import InFolder, main, program, simulation

SHIM = os.environ["FAILING_DISK"]


class Killed(InFolder):
    def setUp(self):
        super().setUp()
        self.write("old.toml", simulation(cut={"axial_depth_mm": 1.0}))
        self.write("new.toml", simulation(cut={"axial_depth_mm": 2.0}))
        for name in ("old", "new"):
            self.run_program("simulate", f"{name}.toml", "-q", "-o", f"{name}.out")

    def contents(self, name):
        folder = self.folder / name
        if not folder.is_dir():
            return None
        return {p.name: hashlib.sha256(p.read_bytes()).hexdigest() for p in folder.iterdir()}

    def hidden(self):
        return {p.name for p in self.folder.rglob(".*")}

    def fault(self, how, at, *arguments, exchange=True, call=None):
        """exit code, what was said"""
        environment = dict(os.environ, LD_PRELOAD=SHIM, FAULT=how, FAULT_AT=str(at))
        if call:
            environment["FAULT_CALL"] = call
        if not exchange:
            environment["NO_EXCHANGE"] = "1"
        done = subprocess.run([program.PROGRAM, *arguments], cwd=self.folder, env=environment,
                              capture_output=True, text=True, timeout=60, check=False)
        return done.returncode, done.stderr

    def everywhere(self, how, before, exchange):
        """a fault at each call in turn: what stands there at once, and after the next run"""
        old = self.contents("old.out") if before else None
        new = self.contents("new.out")
        standing = []
        for at in range(1, 1000):
            shutil.rmtree(self.folder / "out", ignore_errors=True)
            if before:
                shutil.copytree(self.folder / "old.out", self.folder / "out")
            code, said = self.fault(how, at, "simulate", "new.toml", "-q", "-o", "out",
                                    exchange=exchange)
            with self.subTest(how=how, at=at, before=before, exchange=exchange):
                now = self.contents("out")
                standing.append("old" if now == old else "new" if now == new else "neither")
                if how == "error" and "fault" in said and code != 0:
                    self.assertEqual(code, 2, said)
                    self.assertRegex(said, r"cannot write \S*/out")
                    self.assertNotIn(".new-", said)
                    self.assertNotIn(".old-", said)
                self.run_program("simulate", "new.toml", "-q", "-o", "out")
                self.assertEqual(self.contents("out"), new)
                self.assertEqual(self.hidden(), set())
            if "fault" not in said and code != -signal.SIGKILL:
                self.assertEqual(code, 0, said)
                return standing
        self.fail("the writing never ends")

    def test_every_call(self):
        """Each pair of circumstances; each three of them with ./test --all."""
        for how, before, exchange in itertools.product(("error", "kill"), (True, False),
                                                       (True, False)):
            if not program.WHOLE and exchange != ((how == "kill") != before):
                continue
            standing = self.everywhere(how, before, exchange)
            self.assertGreater(len(standing), 20)
            self.assertIn("old", standing)
            self.assertEqual(standing[-1], "new")
            if exchange or how == "error":
                self.assertNotIn("neither", standing)

    def test_where_folders_cannot_be_swapped_the_next_command_puts_the_old_one_back(self):
        old = self.contents("old.out")
        seen = 0
        for at in range(1, 1000):
            shutil.rmtree(self.folder / "out", ignore_errors=True)
            shutil.copytree(self.folder / "old.out", self.folder / "out")
            code, _ = self.fault("kill", at, "simulate", "new.toml", "-q", "-o", "out",
                                 exchange=False)
            if code != -signal.SIGKILL:
                break
            if self.contents("out") is None:
                seen += 1
                self.run_program("report", "out", "-q")
                self.assertEqual(self.contents("out").keys(), old.keys())
                self.assertEqual(self.contents("out")["summary.json"], old["summary.json"])
            self.run_program("simulate", "new.toml", "-q", "-o", "out")
        self.assertGreater(seen, 0)

    def test_everything_is_flushed_to_the_disk_and_a_disk_that_says_no_is_heard(self):
        """every file, the folder and the one that it stands in: a full disk may say so only now"""
        files = len(self.contents("new.out"))
        for arguments, flushed in (
                (("simulate", "new.toml", "-q", "-o", "out"), files + 2),
                (("report", "new.out", "-q"), 2)):
            heard = 0
            while heard < 100:
                shutil.rmtree(self.folder / "out", ignore_errors=True)
                code, said = self.fault("error", heard + 1, *arguments, call="fsync")
                if "fault" not in said:
                    break
                heard += 1
                self.assertEqual(code, 2, said)
                self.assertRegex(said, r"cannot write (\S*/)?(new\.)?out")
                self.assertEqual(self.hidden(), set())
            self.assertEqual(heard, flushed, arguments)

    def test_a_folder_that_cannot_be_read_to_its_end_is_not_taken_for_an_empty_one(self):
        """what somebody else put there would be gone"""
        for at in range(1, 100):
            shutil.rmtree(self.folder / "out", ignore_errors=True)
            self.write("out/mine.txt", "mine\n")
            code, said = self.fault("errors", at, "simulate", "new.toml", "-q", "-o", "out",
                                    call="readdir")
            self.assertEqual(code, 2, said)
            self.assertEqual(self.contents("out").keys(), {"mine.txt"})
            if "fault" not in said:
                break
        self.assertGreater(at, 2)

    def test_where_there_are_no_locks_nothing_of_others_is_removed(self):
        self.run_program("simulate", "new.toml", "-q", "-o", "out")
        self.write("out/.report.html.new-99999", "<html>")
        (self.folder / ".out.new-abcdef").mkdir()
        for arguments in (("report", "out", "-q"), ("simulate", "old.toml", "-q", "-o", "other")):
            self.run_program(*arguments, LD_PRELOAD=SHIM, NO_LOCKS="1")
        self.assertEqual(self.hidden(), {".report.html.new-99999", ".out.new-abcdef"})

    def test_two_writers_at_once_leave_one_whole_answer(self):
        both = (self.contents("old.out"), self.contents("new.out"))
        for _ in range(10):
            running = [subprocess.Popen([program.PROGRAM, "simulate", f"{name}.toml", "-q", "-o", "out"],
                                        cwd=self.folder) for name in ("old", "new") * 3]
            self.assertEqual([p.wait(timeout=60) for p in running], [0] * len(running))
            self.assertIn(self.contents("out"), both)
            self.assertEqual(self.hidden(), set())

    def test_a_report_that_was_killed_is_in_nobodys_way(self):
        self.run_program("simulate", "new.toml", "-q", "-o", "out")
        new = self.contents("out")
        self.write("out/.report.html.new-99999", "<html>")
        self.run_program("report", "out", "-q")
        self.assertEqual(self.contents("out").keys(), new.keys())
        self.assertEqual(self.contents("out")["summary.json"], new["summary.json"])
        self.write("out/.report.html.new-99999", "<html>")
        self.run_program("simulate", "new.toml", "-q", "-o", "out")
        self.assertEqual(self.contents("out"), new)

    def test_a_file_that_may_not_grow_is_said_by_its_own_name(self):
        """RLIMIT_FSIZE: no signal, nothing left over"""
        self.run_program("simulate", "old.toml", "-q", "-o", "out")
        old = self.contents("out")
        done = subprocess.run(["sh", "-c", 'ulimit -f 20; exec "$0" simulate new.toml -o out',
                               program.PROGRAM], cwd=self.folder, capture_output=True, text=True,
                              timeout=60, check=False)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertRegex(done.stderr, r"cannot write \S*/out/\S+: File too large")
        self.assertEqual(self.contents("out"), old)
        self.assertEqual(self.hidden(), set())


if __name__ == "__main__":
    main()
