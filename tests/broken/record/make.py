#!/usr/bin/python3
"""Write the binary files of this folder, each wrong in one way, and sound ones for fuzzing.

/usr/bin/python3 tests/broken/record/make.py writes them again, bit by bit the same.
"""
import pathlib
import struct

here = pathlib.Path(__file__).parent
METADATA, NEW_LIST, RAW = 2, 4, 8


def text(value):
    return struct.pack("<I", len(value)) + value.encode()


def tdms_segment(contents, head, data, promised=None):
    length = len(head) + len(data) if promised is None else promised
    return (b"TDSm" + struct.pack("<IIQQ", contents, 4713, length, len(head))
            + head + data)


def tdms_channel(name, samples, unit="N", kind=10, step=1e-4):
    return (text(f"/'Cut'/'{name}'") + struct.pack("<IIIQ", 20, kind, 1, samples)
            + struct.pack("<I", 2) + text("unit_string") + struct.pack("<I", 0x20)
            + text(unit) + text("wf_increment") + struct.pack("<Id", 10, step))


def tdms(names=("Fx", "Fy", "Fz"), samples=(2, 2, 2), promised=None, **more):
    head = struct.pack("<I", len(names))
    for name, count in zip(names, samples):
        head += tdms_channel(name, count, **more)
    data = b"".join(struct.pack("<d", i) for i in range(sum(samples)))
    return tdms_segment(METADATA | NEW_LIST | RAW, head, data, promised)


whole = tdms()
files = {
    "tdms_cut_off.tdms": whole[:-9],
    "tdms_promises_more.tdms": tdms(promised=1 << 50),
    "tdms_empty.tdms": tdms_segment(METADATA, struct.pack("<I", 0), b""),
    "tdms_no_forces.tdms": tdms(names=("A", "B", "C")),
    "tdms_two_lengths.tdms": tdms(samples=(2, 3, 2)),
    "tdms_volts.tdms": tdms(unit="V"),
    "tdms_no_rate.tdms": tdms(step=0.0),
    "tdms_one_sample.tdms": tdms(samples=(1, 1, 1)),
    "tdms_extended.tdms": tdms(kind=11),
    "tdms_more_samples_than_data.tdms": whole.replace(struct.pack("<IQ", 1, 2),
                                                      struct.pack("<IQ", 1, 1 << 40), 1),
    "tdms_text_too_long.tdms": whole.replace(text("wf_increment"),
                                             b"\xff\xff\xff\x7fwf_increment", 1),
    "tdms_rubbish_after.tdms": whole + b"rubbish",
}
for name, content in files.items():
    (here / name).write_bytes(content)

# The first byte says what the case file says of the record (fuzz_record.cpp).
seeds = {
    "tdms": b"\0" + whole,
}
for name, content in seeds.items():
    (here / "../../fuzz/seeds/record" / name).write_bytes(content)
