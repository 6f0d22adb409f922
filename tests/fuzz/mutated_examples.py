"""Every command over examples changed at random: it answers, or says what is wrong.

    mutated_examples.py [COUNT [FIRST_SEED]]     (TROCHOID names the program)

Whatever the change: exit code 0, 1 or 2, never a signal; a reason where there is no answer;
no NaN in any file; at most 20 s and 1 GB. What fails is kept in a folder that is named.
"""
import collections
import math
import os
import pathlib
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
PROGRAM = os.environ.get("TROCHOID", str(ROOT / "build/release/src/trochoid/cli/trochoid"))
SECONDS = 20.0  # of the processor, on one thread
MEMORY = 1 << 30
SLOWEST = 5  # of all runs, named at the end
RUNS = (("simulate", "ball/case.toml"), ("simulate", "st52_predict/case.toml"),
        ("simulate", "up_milling_runout/case.toml"), ("identify", "st52_slot/case.toml"),
        ("identify", "ringing_dynamometer/case.toml"), ("surface", "thin_wall_2mm_4mm/case.toml"),
        ("surface", "thin_wall_table1/published.toml"), ("calibrate", "thin_wall_table1/case.toml"),
        ("modes", "tap_test/case.toml"), ("modes", "tap_test/tip_x.csv"),
        ("actuator", "tap_test/step.csv"), ("stability", "stability_922Hz/case.toml"),
        ("dynamics", "runout_table_25mm/case.toml"), ("dynamics", "runout_table_8mm/sine.toml"),
        ("correct", "runout_correction/case.toml"), ("plan", "plan_next_cut/case.toml"),
        ("check", "thin_wall_calibrate/case.toml"), ("report", "st52_slot/case.identify"))
EXTREMES = ("0", "-1", "1e18", "-1e30", "1e200", "1e-300", "nan", "inf", "-0.0", "1e308", "3.5",
            "9223372036854775807", "0x7f", "\"\"", "[]", "{}", "true", "1979-05-27", "''")
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?(?![\w.])")


def other_number(random_, text):
    if random_.random() < 0.4:
        return random_.choice(EXTREMES)
    value = float(text) * 10.0 ** random_.randint(-6, 6) * random_.choice((1, 1, 1, -1))
    return repr(value) if random_.random() < 0.8 or not math.isfinite(value) else str(int(value))


def changed_numbers(random_, text):
    found = list(NUMBER.finditer(text))
    for match in sorted(random_.sample(found, min(len(found), random_.randint(1, 2))),
                        key=lambda m: -m.start()):
        text = text[:match.start()] + other_number(random_, match.group()) + text[match.end():]
    return text


def changed_lines(random_, text):
    lines = text.split("\n")
    at = random_.randrange(len(lines))
    kind = random_.randrange(4)
    if kind == 0:
        del lines[at]
    elif kind == 1:
        lines.insert(at, lines[random_.randrange(len(lines))])
    elif kind == 2:
        del lines[at:at + random_.randint(1, max(1, len(lines) // 2))]
    else:
        other = random_.randrange(len(lines))
        lines[at], lines[other] = lines[other], lines[at]
    return "\n".join(lines)


def changed_bytes(random_, text):
    data = bytearray(text.encode(errors="surrogateescape"))
    for _ in range(random_.randint(1, 4)):
        if data:
            data[random_.randrange(len(data))] = random_.randrange(256)
    return data.decode(errors="surrogateescape")


CHANGES = (changed_numbers, changed_numbers, changed_numbers, changed_lines, changed_bytes)


def change_a_file(random_, folder, named):
    """the case twice as often as all else that lies beside it"""
    files = sorted(p for p in folder.rglob("*") if p.is_file() and p.suffix != ".md")
    file = named if named.is_file() and random_.random() < 0.67 else random_.choice(files)
    text = file.read_bytes().decode(errors="surrogateescape")
    text = random_.choice(CHANGES)(random_, text)
    file.write_bytes(text.encode(errors="surrogateescape"))


def limits():
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_CPU, (int(SECONDS), int(SECONDS) + 5))
    resource.setrlimit(resource.RLIMIT_AS, (2 * MEMORY, 2 * MEMORY))


def run(arguments, folder):
    """exit code, what was said, seconds of the processor, bytes"""
    child = subprocess.Popen([PROGRAM, *arguments], cwd=folder, preexec_fn=limits,
                             stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                             stderr=open(folder / "said", "wb"),
                             env=dict(os.environ, TROCHOID_THREADS="1"))
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    said = (folder / "said").read_bytes().decode(errors="replace")
    return child.returncode, said, used.ru_utime + used.ru_stime, used.ru_maxrss * 1024


def complaints(answer, folder):
    code, said, seconds, memory = answer
    if code not in (0, 1, 2):
        yield f"exit code {code}"
    if code in (1, 2) and not said.strip():
        yield "no reason"
    if seconds > SECONDS:
        yield f"{seconds:.0f} s"
    if memory > MEMORY:
        yield f"{memory >> 20} MiB"
    for file in folder.glob("out/*"):
        if file.suffix in (".csv", ".json") and re.search(r"(?i)(?<![\w\"])-?(nan|inf(inity)?)\b(?!\w)",
                                                          re.sub(r'"[^"]*"', '""', file.read_text(errors="replace"))):
            yield f"{file.name} holds a NaN"


def one(seed, bases):
    """the run of this seed, its answer, what is wrong with it and the folder it ran in"""
    random_ = random.Random(seed)
    command, name = random_.choice(RUNS)
    folder = pathlib.Path(tempfile.mkdtemp(prefix="mutated_"))
    place = folder / pathlib.Path(name).parent.name
    shutil.copytree(bases / pathlib.Path(name).parent, place)
    for _ in range(random_.choice((1, 1, 1, 2, 3))):
        change_a_file(random_, place / "case.identify" if command == "report" else place,
                      folder / name)
    arguments = [command, str(folder / name)]
    if command != "report":
        arguments += ["-o", "out"]
    answer = run(arguments, folder)
    return f"{command} {name}", answer, list(complaints(answer, folder)), folder


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    bases = pathlib.Path(tempfile.mkdtemp(prefix="examples_"))
    shutil.copytree(EXAMPLES, bases, dirs_exist_ok=True,
                    ignore=shutil.ignore_patterns("*.identify", "*.calibrate", "*.correct"))
    subprocess.run([PROGRAM, "identify", bases / "st52_slot/case.toml", "-q"], check=True)
    bad = 0
    codes = collections.Counter()
    slow = []
    for seed in range(first, first + count):
        what, (code, _, seconds, memory), wrong, folder = one(seed, bases)
        codes[code] += 1
        slow = sorted([*slow, (seconds, memory >> 20, seed, what)], reverse=True)[:SLOWEST]
        if wrong:
            bad += 1
            print(f"seed {seed}: {what}: {'; '.join(wrong)}; kept in {folder}", flush=True)
        else:
            shutil.rmtree(folder)
    shutil.rmtree(bases)
    print(f"{count} runs, {bad} of them wrong; exit codes:",
          ", ".join(f"{code}: {codes[code]}" for code in sorted(codes)))
    for seconds, memory, seed, what in slow:
        print(f"  {seconds:.1f} s, {memory} MiB: seed {seed}: {what}")
    sys.exit(bad > 0)


if __name__ == "__main__":
    main()
