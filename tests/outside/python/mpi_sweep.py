"""Run by cluster_test.py under mpiexec: a sweep by the ranks beside the first."""

import os
import sys
import warnings

import numpy as np
from mpi4py.futures import MPIPoolExecutor
from sweeping import sweep

import trochoid

if __name__ == "__main__":
    warnings.simplefilter("ignore", trochoid.AnswerWarning)
    with MPIPoolExecutor() as ranks:
        worker = ranks.submit(os.getpid).result()
        found = sweep(executor=ranks)
    table = found.tables["sweep"]
    np.savez(sys.argv[1], processes=[worker, os.getpid()], **table)
