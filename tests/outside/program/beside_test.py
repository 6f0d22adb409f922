"""What lies beside a result folder: whose it is, who waits for whom, and what is put back."""
import contextlib
import errno
import fcntl
import os
import shutil
import subprocess
import time

from in_folder import InFolder, main, program, simulation

LETTERS = "abcdef"
PATIENCE = 1.0  # s that a program is seen to wait; one that does not wait is done in a tenth


@contextlib.contextmanager
def locked(folder):
    """as another program holds it"""
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield
    finally:
        os.close(descriptor)


def is_locked(folder):
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return False
    except OSError as error:
        assert error.errno == errno.EWOULDBLOCK
        return True
    finally:
        os.close(descriptor)


class Place(InFolder):
    def setUp(self):
        super().setUp()
        self.write("cut.toml", simulation())
        self.run_program("simulate", "cut.toml", "-q", "-o", "whole")

    def left(self, kind, letters=LETTERS, place="out", **files):
        """a folder as a killed program leaves it, with files of the answer"""
        folder = self.folder / f".{place}.{kind}-{letters}"
        folder.mkdir()
        for name in files.get("files", ()):
            shutil.copy(self.folder / "whole" / name, folder)
        return folder

    def simulate(self, *more):
        self.run_program("simulate", "cut.toml", "-q", "-o", "out", *more)

    def started(self, *arguments):
        return subprocess.Popen([program.PROGRAM, *arguments], cwd=self.folder,
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def assert_waits(self, running):
        with self.assertRaises(subprocess.TimeoutExpired):
            running.wait(timeout=PATIENCE)

    def assert_done(self, running):
        self.assertEqual(running.wait(timeout=program.HANGS), 0)

    def test_what_a_killed_program_left_is_removed(self):
        for kind in ("new", "old"):
            folder = self.left(kind, files=("forces.csv",))
            self.simulate()
            self.assertFalse(folder.exists(), kind)

    def test_what_a_living_program_fills_is_left_alone(self):
        for kind in ("new", "old"):
            folder = self.left(kind, files=("forces.csv",))
            with locked(folder):
                self.simulate()
                self.assertTrue((folder / "forces.csv").exists(), kind)
            shutil.rmtree(folder)

    def test_what_is_not_ours_is_left_alone_whatever_its_name(self):
        folders = [self.left("new", letters="longer0"), self.left("new", letters="short"),
                   self.left("new", place="outside")]
        holding_more = self.left("new", files=("forces.csv",))
        (holding_more / "mine.txt").write_text("mine\n")
        holding_a_link = self.left("new", letters="bcdefg")
        (holding_a_link / "forces.csv").symlink_to(self.folder / "cut.toml")
        holding_a_folder = self.left("old", letters="cdefgh")
        (holding_a_folder / "forces.csv").mkdir()
        file = self.write(".out.new-defghi", "mine\n")
        target = self.left("new", place="elsewhere", files=("forces.csv",))
        link = self.folder / ".out.new-efghij"
        link.symlink_to(target)
        before = self.everything()
        self.simulate()
        shutil.rmtree(self.folder / "out")
        self.assertEqual(self.everything(), before)
        for one in (*folders, holding_more, holding_a_link, holding_a_folder, file, link, target):
            self.assertTrue(os.path.lexists(one), one)

    def test_of_two_that_were_set_aside_the_whole_one_is_put_back(self):
        names = os.listdir(self.folder / "whole")
        for whole, part in (("aaaaaa", "bbbbbb"), ("bbbbbb", "aaaaaa")):
            self.left("old", whole, files=names)
            self.left("old", part, files=("forces.csv",))
            self.run_program("report", "out", "-q")
            self.assertEqual(sorted(os.listdir(self.folder / "out")), sorted(names))
            self.assertEqual(list(self.folder.glob(".out*")), [])
            shutil.rmtree(self.folder / "out")

    def test_one_that_was_set_aside_does_not_replace_an_answer(self):
        self.simulate("--no-report")
        before = self.everything()
        self.left("old", files=os.listdir(self.folder / "whole"))
        self.run_program("report", "out", "-q")
        (self.folder / "out/report.html").unlink()
        shutil.rmtree(self.folder / f".out.old-{LETTERS}", ignore_errors=True)
        self.assertEqual(self.everything(), before)

    def test_a_command_waits_for_another_one_that_changes_the_same_place(self):
        with locked(self.folder):
            running = self.started("simulate", "cut.toml", "-q", "-o", "out")
            self.assert_waits(running)
            self.assertFalse((self.folder / "out").exists())
        self.assert_done(running)

    def test_a_report_waits_too(self):
        with locked(self.folder):
            running = self.started("report", "whole", "-q")
            self.assert_waits(running)
        self.assert_done(running)

    def test_what_bears_a_name_of_ours_but_is_no_file_is_kept(self):
        for make in (lambda path: path.mkdir(), lambda path: path.symlink_to(self.folder / "cut.toml")):
            shutil.copytree(self.folder / "whole", self.folder / "out")
            table = self.folder / "out/forces.csv"
            table.unlink()
            make(table)
            before = self.everything()
            said = self.run_program("simulate", "cut.toml", "-q", "-o", "out", code=2).stderr
            self.assertIn("it contains 'forces.csv', which trochoid did not write", said)
            self.assertEqual(self.everything(), before)
            shutil.rmtree(self.folder / "out")

    def caught_while_it_writes(self):
        """A program with a long table to write, its hidden folder, and the lock of the place."""
        self.write("long.toml", simulation(sampling={"samples_per_rev": 3600, "revolutions": 60}))
        for _ in range(20):
            shutil.rmtree(self.folder / "long.simulate", ignore_errors=True)
            running = self.started("simulate", "long.toml", "-q")
            while running.poll() is None and not list(self.folder.glob(".long.simulate.new-*")):
                time.sleep(0.002)
            lock = contextlib.ExitStack()
            lock.enter_context(locked(self.folder))
            hidden = list(self.folder.glob(".long.simulate.new-*"))
            if hidden and running.poll() is None:
                # Without its folder it was the trial whether one can be made there: the
                # program now waits for us.
                while (hidden[0].exists() and not (hidden[0] / "summary.json").exists()
                       and running.poll() is None):
                    time.sleep(0.01)  # the last of its files
                if hidden[0].exists():
                    return running, hidden[0], lock
            lock.close()
            self.assert_done(running)
        self.fail("never caught")

    def test_an_answer_is_put_in_place_under_the_lock_and_held_until_then(self):
        running, hidden, lock = self.caught_while_it_writes()
        with lock:
            self.assertTrue(is_locked(hidden))
            self.assert_waits(running)
            self.assertFalse((self.folder / "long.simulate").exists())
        self.assert_done(running)

    def test_what_somebody_puts_there_meanwhile_is_kept(self):
        running, _, lock = self.caught_while_it_writes()
        with lock:
            mine = self.write("long.simulate/mine.txt", "mine\n")
        self.assertEqual(running.wait(timeout=program.HANGS), 2)
        self.assertEqual(mine.read_text(), "mine\n")
        self.assertEqual(list(self.folder.glob(".long.simulate.*")), [])


if __name__ == "__main__":
    main()
