"""What takes longer than two seconds says so on the standard error, in plain lines on a pipe."""
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time

from in_folder import InFolder, ROOT, main, program, simulation


def processor_time(pid):
    """What a process has computed so far, in seconds."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return int(fields[11]) / os.sysconf("SC_CLK_TCK")


class Progress(InFolder):
    def said(self, *options):
        """What a run says that was held up for three seconds while it fitted."""
        for name in ("case.toml", "profile.csv"):
            shutil.copy(ROOT / "examples/thin_wall_calibrate" / name, self.folder)
        run = subprocess.Popen(
            [program.PROGRAM, "calibrate", "case.toml", "--no-report", *options],
            cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.PIPE, text=True)
        while run.poll() is None and processor_time(run.pid) < 0.15:  # of more than a second
            time.sleep(0.01)
        run.send_signal(signal.SIGSTOP)
        time.sleep(3.0)
        run.send_signal(signal.SIGCONT)
        _, said = run.communicate(timeout=program.HANGS)
        self.assertEqual(run.returncode, 0, said)
        return said

    def test_a_pipe_gets_plain_lines(self):
        said = self.said()
        self.assertRegex(said, r"^[A-Z][a-z ]+, \d+ s\n")
        self.assertNotIn("\r", said)
        for line in said.splitlines():
            self.assertIsNotNone(re.fullmatch(r"[A-Z][a-z ]+, \d+ s", line), line)

    def test_quiet_says_nothing(self):
        self.assertEqual(self.said("--quiet"), "")

    def test_verbose_tells_of_every_step(self):
        self.write("cut.toml", simulation())
        for options, told in (((), False), (("--verbose",), True), (("--verbose", "-q"), False)):
            # Not by run_program, which takes what is told of the progress away.
            done = subprocess.run([program.PROGRAM, "simulate", "cut.toml", *options],
                                  cwd=self.folder, capture_output=True, text=True, check=True)
            lines = done.stderr.splitlines()
            for line in lines:
                self.assertRegex(line, r"^ +\d+\.\d\d s  [A-Z][a-z ]+$")
            self.assertEqual([line for line in lines if line.endswith("Writing the results")]
                             != [], told, options)

    def test_threads_come_before_the_environment(self):
        self.write("cut.toml", simulation())
        self.run_program("simulate", "cut.toml", code=2, TROCHOID_THREADS="many")
        self.run_program("simulate", "cut.toml", "--threads", 2, TROCHOID_THREADS="many")
        self.run_program("simulate", "cut.toml", "--threads", 0, code=2)


if __name__ == "__main__":
    main()
