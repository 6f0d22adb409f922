#!/usr/bin/python3
"""Write the binary files of this folder, each wrong in one way, and sound ones for fuzzing.

What is text stands in the tables of this folder.
/usr/bin/python3 tests/broken/record/make.py writes them again, bit by bit the same.
"""
import io
import pathlib
import struct
import zlib

import numpy as np
import scipy.io

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


def mat(variables, compress=False):
    out = io.BytesIO()
    scipy.io.savemat(out, variables, do_compression=compress, oned_as="column")
    raw = bytearray(out.getvalue())
    # The date of today would make other bytes every day.
    raw[:116] = b"MATLAB 5.0 MAT-file, made for a test".ljust(116)
    return bytes(raw)


def mat_object():
    """A table as MATLAB writes it: class 17, of which only names can be read."""
    def element(kind, data):
        return struct.pack("<II", kind, len(data)) + data + b"\0" * (-len(data) % 8)
    body = element(6, struct.pack("<II", 17, 0))
    body += element(1, b"forces") + element(1, b"MCOS") + element(1, b"table")
    body += mat({"x": np.ones((6, 1), dtype=np.uint32)})[128:]
    return mat({})[:128] + element(14, body)


vector = np.arange(1.0, 5.0)
forces = {"Fx": vector, "Fy": 10 * vector, "Fz": 100 * vector, "t": vector}
sound = mat(forces)
packed = mat(forces, compress=True)
named = mat({"data": {**forces, "note": "text"}}, compress=True)
bomb = bytearray(mat({"Fx": np.zeros(1)}))
at = bomb.index(struct.pack("<IIII", 5, 8, 1, 1)) + 8
bomb[at:at + 8] = struct.pack("<II", 1 << 30, 4)
inner = zlib.compress(struct.pack("<II", 14, 0x7F000000) + b"\0" * 4000)
packed_bomb = sound[:128] + struct.pack("<II", 15, len(inner)) + inner
mats = {
    "mat_cut_off.mat": sound[:-20],
    "mat_head_alone.mat": sound[:128],
    "mat_head_cut_off.mat": sound[:100],
    "mat_no_variable.mat": sound + b"rubbish and more",
    "mat_packed_damaged.mat": packed[:150] + b"\xff" * 20 + packed[170:],
    "mat_no_forces.mat": mat({"a": vector, "b": vector}),
    "mat_two_matrices.mat": mat({"a": np.ones((5, 3)), "b": np.ones((5, 3))}),
    "mat_matrix_without_time.mat": mat({"a": np.ones((5, 3))}),
    "mat_two_lengths.mat": mat({**forces, "Fy": np.ones(3)}),
    "mat_not_finite.mat": mat({**forces, "Fz": np.array([1, 2, np.nan, 4])}),
    "mat_table.mat": mat_object(),
    "mat_bomb.mat": bytes(bomb),
    "mat_packed_bomb.mat": packed_bomb,
    "mat_complex.mat": mat({k: v * 1j for k, v in forces.items()}),
}
for name, content in mats.items():
    (here / name).write_bytes(content)


def npy(array, version=None):
    out = io.BytesIO()
    np.lib.format.write_array(out, array, version=version)
    return out.getvalue()


samples = np.arange(20.0).reshape(5, 4)
rows = np.zeros(3, dtype=[("time_s", "<f8"), ("Fx_N", ">f4"), ("Fy_N", "<i2"), ("Fz_N", "<i4")])
rows["time_s"] = [0, 1, 2]
nested = np.zeros(3, dtype=[("F", [("x", "<f8"), ("y", "<f8")])])
arrays = {
    "npy_cut_off.npy": npy(samples)[:-9],
    "npy_head_cut_off.npy": npy(samples)[:50],
    "npy_without_rate.npy": npy(np.ones((5, 3))),
    "npy_two_columns.npy": npy(np.ones((5, 2))),
    "npy_three_dimensions.npy": npy(np.ones((5, 3, 2))),
    "npy_complex.npy": npy(samples * 1j),
    "npy_half.npy": npy(samples.astype("<f2")),
    "npy_several.npy": npy(samples) + npy(samples),
    "npy_not_finite.npy": npy(np.where(samples == 6, np.nan, samples)),
    "npy_of_nothing.npy": npy(samples[:0]),
    "npy_nested.npy": npy(nested),
    "npy_promises_more.npy": npy(samples).replace(b"(5, 4), }", b"(500000000000, 4), }"),
    "npy_no_description.npy": npy(samples).replace(b"'descr'", b"'dscr' "),
}
for name, content in arrays.items():
    (here / name).write_bytes(content)

# The first byte says what the case file says of the record (fuzz_record.cpp).
seeds = {
    "tdms": b"\0" + whole,
    "mat": b"\0" + sound,
    "npy": b"\0" + npy(samples),
    "npy_fields": b"\0" + npy(rows, (2, 0)),
    "mat_packed": b"\0" + packed,
    "mat_struct": b"\0" + named,
}
for name, content in seeds.items():
    (here / "../../fuzz/seeds/record" / name).write_bytes(content)
