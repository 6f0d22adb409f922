"""Rows of a sweep by processes of Dask and of MPI, as on many machines."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import warnings

import numpy as np
from sweeping import LONG, Killer, Sweeping, sweep

import trochoid

warnings.simplefilter("ignore", trochoid.AnswerWarning)


class Clusters(Sweeping):
    @classmethod
    def setUpClass(cls):
        cls.wanted = sweep()

    def test_dask_and_a_worker_of_it_killed(self):
        try:
            import distributed
        except ImportError:
            self.skipTest("python3-distributed is not here")
        warnings.simplefilter("ignore")  # of distributed: its own threads and sockets
        cluster = distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address=None,
            silence_logs=60, local_directory=str(self.folder),
        )
        with cluster, distributed.Client(cluster) as client:
            workers = list(client.run(os.getpid).values())
            self.assertEqual(len(set(workers) | {os.getpid()}), 3)
            killer = Killer(workers[0])
            found = sweep(LONG, executor=client.get_executor(), progress=killer)
        self.assertEqual(killer.processes, [], "one was killed")
        self.assertLess(killer.calls[0][0], killer.calls[-1][0])
        self.same(found, sweep(LONG))

    def test_mpi(self):
        try:
            import mpi4py  # noqa: F401
        except ImportError:
            self.skipTest("python3-mpi4py is not here")
        if shutil.which("mpiexec") is None:
            self.skipTest("mpiexec is not here")
        here = pathlib.Path(__file__).resolve().parent
        rows = self.folder / "rows.npz"
        short = tempfile.mkdtemp(dir="/tmp")  # MPI's names of sockets are cut when long
        self.addCleanup(shutil.rmtree, short, True)
        allowed = {
            "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
            "OMPI_MCA_btl": "self,tcp", "OMPI_MCA_btl_tcp_if_include": "lo",
            "OMPI_MCA_plm": "isolated", "TMPDIR": short,
        }
        run = subprocess.run(
            ["mpiexec", "-n", "3", "--oversubscribe", sys.executable, "-m", "mpi4py.futures",
             here / "mpi_sweep.py", rows],
            env={**os.environ, **allowed}, capture_output=True, text=True, timeout=120,
        )
        self.assertEqual(run.returncode, 0, run.stderr)
        with np.load(rows, allow_pickle=True) as found:
            self.assertEqual(len(set(found["processes"])), 2)
            for name, column in self.wanted.tables["sweep"].items():
                if column.dtype.kind == "f":
                    self.assertEqual(column.tobytes(), found[name].tobytes(), name)
                else:
                    self.assertEqual(list(column), list(found[name]), name)


if __name__ == "__main__":
    unittest.main()
