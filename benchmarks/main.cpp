#include <trochoid/numerics/parallel.h>

#include <benchmark/benchmark.h>

// On one thread, so that the CPU time of this thread is all of it.
int main(int argc, char** argv) {
  const trochoid::numerics::ThreadLimit one_thread(1);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return 1;
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
