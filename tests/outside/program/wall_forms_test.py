"""One wall as different machines export it: each form gives the answer of the plain one."""
import csv
import math
import struct
import zipfile

from in_folder import ROOT, InFolder, main

EXAMPLE = ROOT / "examples/thin_wall_calibrate"
INCH = 25.4
# Numbers are written with digits enough; the fit ends at steps of 1e-6 of a coefficient.
SAME = 1e-5

X3P = """<?xml version="1.0" encoding="UTF-8" standalone="no" ?>
<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2"
  xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"
  xsi:schemaLocation="http://www.opengps.eu/2008/ISO5436_2 ISO5436_2.xsd">
  <Record1><Revision>ISO5436 - 2000</Revision><FeatureType>SUR</FeatureType>
    <Axes>
      <CX><AxisType>I</AxisType><DataType>D</DataType><Increment>{dx!r}</Increment>
        <Offset>{x0!r}</Offset></CX>
      <CY><AxisType>I</AxisType><DataType>D</DataType><Increment>{dy!r}</Increment>
        <Offset>{y0!r}</Offset></CY>
      <CZ><AxisType>A</AxisType><DataType>D</DataType><Increment>1</Increment>
        <Offset>0</Offset></CZ>
    </Axes></Record1>
  <Record2><Date>2026-03-04T12:00:00</Date><Creator>a test</Creator></Record2>
  <Record3><MatrixDimension><SizeX>{nx}</SizeX><SizeY>{ny}</SizeY><SizeZ>1</SizeZ>
    </MatrixDimension><DataLink><PointDataLink>bindata/data.bin</PointDataLink></DataLink>
  </Record3><Record4><ChecksumFile>md5checksum.hex</ChecksumFile></Record4>
</p:ISO5436_2>
"""


def readings():
    """x, height and error of the example, all in mm."""
    lines = (EXAMPLE / "profile.csv").read_text().splitlines()
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    return [tuple(float(row[name]) for name in ("x_mm", "height_mm", "error_mm"))
            for row in rows]


def comma(value, digits):
    return f"{value:.{digits}f}".replace(".", ",")


class WallForms(InFolder):
    @classmethod
    def setUpClass(cls):
        cls.rows = readings()
        # The quickest fit: here files are what is tried.
        cls.case = (EXAMPLE / "case.toml").read_text().replace(
            'model = "envelope"', 'model = "imprint"').replace(
            "datum_offset = true", 'form = "offset"')
        assert cls.case.count("imprint") == cls.case.count('form = "offset"') == 1

    def answer(self, name, keys="", code=0):
        """Result and warnings for a file of the folder."""
        text = self.case.replace('file = "profile.csv"', f'file = "{name}"\n{keys}')
        self.assertIn(name, text)
        self.write("wall.toml", text)
        self.run_program("check", "wall.toml", code=code)
        self.run_program("calibrate", "wall.toml", "--no-report", code=code)
        return self.summary("wall.calibrate")

    def expect_same(self, summary):
        """The answer of profile.csv."""
        result = summary["result"]
        for key, entry in self.plain["coefficients"].items():
            for part in ("value", "se"):
                self.assertAlmostEqual(
                    result["coefficients"][key][part] / entry[part], 1.0, delta=SAME)
        self.assertEqual(result["readings"]["used"], len(self.rows))

    def warned(self, summary, code):
        return any(code in str(warning) for warning in summary["warnings"])

    def setUp(self):
        super().setUp()
        self.write("profile.csv", (EXAMPLE / "profile.csv").read_bytes())
        if not hasattr(type(self), "plain"):
            type(self).plain = self.answer("profile.csv")["result"]

    def test_inches_between_head_and_statistics(self):
        rows = "".join(f"P{i}\t{x / INCH:.13f}\t{h / INCH:.13f}\t{e / INCH * 1000:.10f}\n"
                       for i, (x, h, e) in enumerate(self.rows))
        self.write("inch.txt", "CMM-Manager 3.8\nPart: wall 7\nOperator: K. Meyer\n\n"
                   "Point\tX [in]\tHeight [in]\tDeviation [thou]\n" + rows +
                   "\nStatistics\nMean\t\t\t1.2\nPage 1 of 1\n")
        summary = self.answer("inch.txt")
        self.expect_same(summary)
        self.assertTrue(self.warned(summary, "lines_skipped"))

    def test_blanks_and_decimal_commas_in_german(self):
        head = f"{'Position [mm]':>16}{'Höhe [mm]':>14}{'Abw. [µm]':>14}\n"
        rows = "".join(f"{comma(x, 3):>16}{comma(h, 2):>14}{comma(1000 * e, 3):>14}\n"
                       for x, h, e in self.rows)
        for name, coding in (("utf8.txt", "utf-8"), ("latin1.txt", "latin-1")):
            self.write(name, (head + rows).encode(coding))
            self.expect_same(self.answer(name))

    def test_coordinates_in_a_frame(self):
        """The wall along -Y of the machine, its outside towards -X, the tip at Z = 40."""
        rows = "".join(f"{7 - e:.6f};{250 - x:.6f};{40 + h:.6f}\n" for x, h, e in self.rows)
        self.write("points.csv", "X;Y;Z\n" + rows)
        self.expect_same(self.answer(
            "points.csv", 'unit = "mm"\nframe = { origin_mm = [7, 250, 40], '
            'feed = "-y", normal = "-x", up = "+z" }'))

    def test_nominal_and_measured_values_with_gaps(self):
        rows = "".join(f"{x!r};{h!r};-5.000;{-5 + e:.4f}\n" for x, h, e in self.rows)
        self.write("soll.csv", "x;z;Soll;Ist\n" + "1;1;-5.000;*****\n2;1;-5.000;\n" + rows)
        summary = self.answer("soll.csv", 'unit = "mm"')
        self.expect_same(summary)
        self.assertEqual(summary["result"]["readings"]["skipped"], 2)
        self.assertTrue(self.warned(summary, "readings_skipped"))

    def test_every_reading_twice(self):
        """The mean is the reading; 2 um apart, their standard deviation is sqrt(2) um."""
        rows = "".join(f"{x!r},{h!r},{1000 * e + d:.4f}\n" for d in (1, -1)
                       for x, h, e in self.rows)
        self.write("twice.csv", "x_mm,height_mm,error_um\n" + rows)
        summary = self.answer("twice.csv")
        self.expect_same(summary)
        told = summary["result"]["readings"]
        self.assertEqual(told["repeats"], len(self.rows))
        self.assertAlmostEqual(told["repeatability_mm"], math.sqrt(2) * 1e-3, delta=1e-9)

    def grid(self):
        """The readings as a map: sizes, steps [m], first point [m] and z [m]."""
        xs = sorted({x for x, _, _ in self.rows})
        hs = sorted({h for _, h, _ in self.rows})
        at = {(x, h): e for x, h, e in self.rows}
        self.assertEqual(len(at), len(xs) * len(hs))
        step = [(v[-1] - v[0]) / (len(v) - 1) / 1000 for v in (xs, hs)]
        z = [at[x, h] / 1000 for h in hs for x in xs]
        return len(xs), len(hs), *step, xs[0] / 1000, hs[0] / 1000, z

    def test_a_map_in_x3p(self):
        nx, ny, dx, dy, x0, y0, z = self.grid()
        with zipfile.ZipFile(self.folder / "wall.x3p", "w", zipfile.ZIP_DEFLATED) as out:
            out.writestr("main.xml", X3P.format(nx=nx, ny=ny, dx=dx, dy=dy, x0=x0, y0=y0))
            out.writestr("bindata/data.bin", struct.pack(f"<{len(z)}d", *z))
        self.expect_same(self.answer("wall.x3p"))

    def test_a_map_in_sdf(self):
        """It begins at 0: the frame says where. A column beside the wall is left out."""
        nx, ny, dx, dy, x0, y0, z = self.grid()
        frame = (f"frame = {{ origin_mm = [{-1000 * x0!r}, {-1000 * y0!r}, 0], "
                 'feed = "+x", normal = "+z", up = "+y" }')
        head = (b"bISO-1.0" + b"a test".ljust(10) + b"0" * 24 +
                struct.pack("<HHddddBBB", nx, ny, dx, dy, 1.0, -1.0, 0, 7, 0))
        self.write("binary.sdf", head + struct.pack(f"<{len(z)}d", *z))
        self.expect_same(self.answer("binary.sdf", frame))
        text = "".join(f"{1e6 * v:.6f}\n" for v in z)
        self.write("text.sdf", f"aISO-1.0\nManufacID = a test\nNumPoints = {nx}\n"
                   f"NumProfiles = {ny}\nXscale = {dx!r}\nYscale = {dy!r}\nZscale = 1E-6\n"
                   f"Zresolution = -1\nCompression = 0\nDataType = 7\nCheckType = 0\n*\n"
                   f"{text}*\n")
        self.expect_same(self.answer("text.sdf", frame))

    def test_a_wrong_unit_is_named(self):
        rows = "".join(f"{x!r},{1000 * h!r},{e!r}\n" for x, h, e in self.rows)
        self.write("wrong.csv", "x_mm,height_mm,error_mm\n" + rows)
        text = self.case.replace("profile.csv", "wrong.csv")
        self.write("wall.toml", text)
        for command in ("check", "calibrate"):
            said = self.run_program(command, "wall.toml", code=2).stderr
            self.assertIn("in um instead of mm all readings would lie inside", said)


if __name__ == "__main__":
    main()
