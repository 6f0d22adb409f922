#!/usr/bin/env python3
"""Two threads, the spindle in a fast one and the controller in a slower: how late they run.

Usage: latency.py MODULES OFFLINE, as hal_test.py; `ninja linuxcnc_latency`. Not a test: without
a real-time kernel the numbers are those of the machine and of what else it does.
"""

import hal_test

SECONDS = 20
HAL = f"""
loadusr -Wn threads ./rtapi_app load threads name1=fast period1=100000 name2=servo period2=500000
loadrt trochoid_correct table=table.csv
loadrt trochoid_bench
loadrt timedelta names=fast-time,servo-time
setp trochoid-correct.0.start-um 30
setp trochoid-correct.0.lead-s 2.268e-3
setp trochoid-bench.0.enable-at 3000
net index trochoid-correct.0.index-enable trochoid-bench.0.index-enable
net position trochoid-bench.0.position trochoid-correct.0.position
net speed trochoid-bench.0.speed trochoid-correct.0.speed
net enable trochoid-bench.0.enable trochoid-correct.0.enable
net force trochoid-bench.0.force trochoid-correct.0.force
net command trochoid-correct.0.command-um trochoid-bench.0.command-um
addf fast-time fast
addf trochoid-bench.0.spindle fast
addf trochoid-bench.0.cut fast
addf servo-time servo
addf trochoid-correct.0 servo
start
loadusr -w sleep {SECONDS}
"""
PINS = ("fast-time.min", "fast-time.max", "servo-time.min", "servo-time.max",
        "trochoid-correct.0.time", "trochoid-correct.0.tmax", "trochoid-correct.0.state",
        "trochoid-correct.0.fault", "trochoid-bench.0.flute1", "trochoid-bench.0.flute2",
        "trochoid-correct.0.fade")


def main():
    halrun = hal_test.Halrun()
    try:
        (halrun.folder / "table.csv").write_text(hal_test.table_text(14.0))
        said = halrun.run(HAL + "".join(f"getp {pin}\n" for pin in PINS)
                          + "stop\nunloadrt all\n")
        values = [line for line in said.splitlines()
                  if line.strip() and not line.startswith("Note:")][-len(PINS):]
        for pin, value in zip(PINS, values):
            print(f"{pin:28s} {value.strip()}")
    finally:
        halrun.close()


if __name__ == "__main__":
    main()
