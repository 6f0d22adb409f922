"""Every worked case of ../shared/cases/edges_sensors that has a kind known here, through
the program as a user would: forces of any edges, and the finish they leave.

The expected values and the tolerances stand in the files. Other files of the same kinds
are run just the same.
"""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "reference"))
import case_file as cf  # noqa: E402
import program  # noqa: E402
from worked_folder import WorkedFolder, cells, main  # noqa: E402

INDEX = {"x": 0, "y": 1, "z": 2}


class EdgesCases(WorkedFolder):
    CASES = cf.SHARED / "cases/edges_sensors"

    def run_case(self, command, c, name, **changed):
        tables = {k: v for k, v in c["case"].items() if k != "title"}
        tables = {k: dict(v) for k, v in tables.items()}
        for table, keys in changed.items():
            tables[table] = {**tables.get(table, {}), **keys}
            tables[table] = {k: v for k, v in tables[table].items() if v is not None}
        tables["cut"].setdefault("spindle_rpm", 1200)
        text = program.case_text(name, tables)
        answer = program.run(command, text, self.folder, name)
        self.assertEqual(answer.code, 0, f"{name}: exit {answer.code}\n{answer.stderr}\n{text}")
        return answer

    def test_forces(self):
        self.of_kind("forces", self.check_forces)

    def test_finish(self):
        self.of_kind("finish", self.check_finish)

    # forces

    def check_forces(self, c, want, tol, out):
        answer = self.run_case("simulate", c, c["id"], tool={"gauge_length_mm": None})
        col = answer.columns("forces.csv")
        for q, axis in enumerate("xyz"):
            out.all_near(col[f"F{axis}_N"], [F[q] for F in want["F_N"]], tol["F_N"],
                         f"F{axis}")
        mean = want["mean_of_turn"]
        out.all_near(answer.result["exact_mean_N"], mean["F_N"], tol["mean_of_turn_N"],
                     "exact_mean_N")
        # The torque of the mean is as good as its force times the radius.
        reach = tol["mean_of_turn_N"] * tol["torque_Nm"] / tol["F_N"]
        out.near(answer.result["exact_mean_torque_Nm"], mean["torque_Nm"], reach,
                 "exact_mean_torque_Nm")
        self.check_chips(c, answer, want, tol, out)
        self.check_grid(c, want["grid"], tol, out)
        self.check_matrix(c, want, tol, out)

    def check_grid(self, c, want, tol, out):
        angles = [want["first_deg"] + i * want["step_deg"] for i in range(want["count"])]
        answer = self.run_case("simulate", c, c["id"] + "_grid",
                               sampling={"angles_deg": angles, "edge_angles_deg": None,
                                         "edge_heights_mm": None})
        r = answer.result
        for key in ("mean_N", "min_N", "max_N", "rms_N"):
            out.all_near(r[key], want[key], tol["F_N"], key)
        out.near(r["peak_xy_N"], want["peak_xy_N"], 2 * tol["F_N"], "peak_xy_N")
        out.near(r["torque_mean_Nm"], want["torque_mean_Nm"], tol["torque_Nm"], "torque_mean")
        out.near(r["torque_peak_Nm"], want["torque_peak_Nm"], tol["torque_Nm"], "torque_peak")

    def check_matrix(self, c, want, tol, out):
        """[C]: the force of one coefficient at a time, the others zero"""
        first = want["C_first"]
        keys = ("K_tc_MPa", "K_rc_MPa", "K_ac_MPa",
                "K_te_N_per_mm", "K_re_N_per_mm", "K_ae_N_per_mm")
        if c["case"]["force"].get("law", "linear_edge") != "linear_edge":
            return
        largest = sum(abs(c["case"]["force"][k]) for k in keys[:3])
        for column, key in enumerate(keys):
            force = {k: 1000.0 if k == key else 0.0 for k in keys}
            answer = self.run_case("simulate", c, f"{c['id']}_{key}", force=force,
                                   sampling={"angles_deg": [first["angle_deg"]],
                                             "edge_angles_deg": None, "edge_heights_mm": None})
            col = answer.columns("forces.csv")
            for row, axis in enumerate("xyz"):
                out.near(col[f"F{axis}_N"][0] / 1000, first["C"][row][column],
                         max(tol["F_N"] / largest, 1e-7 * abs(first["C"][row][column])),
                         f"C[{row}][{column}]")

    def check_chips(self, c, answer, want, tol, out):
        chips = {(int(r["tooth"]), round(float(r["height_mm"]), 9),
                  round(float(r["edge_angle_deg"]), 9)): (float(r["h_mm"]), int(r["mark"]))
                 for r in cells(answer.folder / "chip.csv")}
        edges = {(int(r["tooth"]), round(float(r["height_mm"]), 9)): r
                 for r in cells(answer.folder / "edges.csv")}
        heights = {round(h["height_mm"], 9): h for h in answer.result["heights"]}
        theta = c["case"]["sampling"]["edge_angles_deg"]
        for layer in want["chips"]:
            z = round(layer["height_mm"], 9)
            if layer.get("area_per_turn_mm2") is not None:
                area = layer["area_per_turn_mm2"]
                out.near(heights[z]["removed_mm2_per_rev"], area, tol["area_relative"] * area,
                         f"area at {z}")
            for tooth in layer["teeth"]:
                j, what = tooth["tooth"], f"tooth {tooth['tooth']} at {z}"
                self.check_edge(edges[j, z], tooth, out, what)
                if not tooth["here"]:
                    continue
                got = [chips[j, z, round(t, 9)] for t in theta]
                out.all_near([h for h, _ in got], tooth["h_mm"], tol["h_mm"], f"h of {what}")
                out.all_near([m for _, m in got], tooth["mark"], 0, f"mark of {what}")
                spans = heights[z]["intervals_deg"][j - 1]
                out.all_near(sum(spans, []), sum(tooth["intervals_deg"], []),
                             tol["interval_deg"], f"intervals of {what}")
        lowest = [t["lowest_height_mm"] for t in answer.result["teeth"]]
        out.all_near(lowest, want["lowest_height_mm"], 1e-9, "lowest_height_mm")

    def check_edge(self, row, tooth, out, what):
        if (row["there"] == "1") != tooth["here"]:
            out.append(f"{what}: there {row['there']}, expected {tooth['here']}")
        elif not tooth["here"]:
            if row["radius_mm"] or row["kappa_deg"]:
                out.append(f"{what}: not there, and yet {row}")
        else:
            for column, key in (("radius_mm", "radius_mm"), ("eps_deg", "turned_forward_deg"),
                                ("omega_deg", "behind_tip_of_tooth_1_deg"),
                                ("kappa_deg", "kappa_deg"),
                                ("ds_dz", "edge_length_per_height")):
                want = tooth[key]
                out.near(float(row[column]), want, 1e-9 * max(1, abs(want)), f"{column} of {what}")

    # finish

    def check_finish(self, c, want, tol, out):
        answer = self.run_case("surface", c, c["id"])
        r = answer.result
        out.near(r["period_mm"], want["period_mm"], 1e-12, "period_mm")
        for line, expected in zip(r.get("floor", []), want.get("floor", [])):
            self.check_line(line, expected, tol, out, f"floor at {expected['y_mm']}",
                            ("mean_mm", "lowest_mm", "highest_mm"))
        for line, expected in zip(r.get("heights", []), want.get("wall", [])):
            self.check_line(line, expected, tol, out, f"wall at {expected['height_mm']}",
                            ("mean_error_mm", "min_error_mm", "max_error_mm"))
        if len(r.get("floor", [])) != len(want.get("floor", [])):
            out.append("floor: not as many lines")
        self.check_points(c, want, tol, out)

    def check_line(self, line, want, tol, out, what, names):
        # Extremes are found between the points that the file looked at: they are wider.
        roughness = tol["roughness_um"]
        out.near(line[names[0]], want["mean_mm"], tol["mean_mm"], f"mean, {what}")
        out.near(line[names[1]], want["lowest_mm"], 1e-3 * roughness, f"lowest, {what}")
        out.near(line[names[2]], want["highest_mm"], 1e-3 * roughness, f"highest, {what}")
        for key in ("Ra_um", "Rq_um", "Rz_um"):
            out.near(line[key], want[key], roughness, f"{key}, {what}")
        for key, value in want.get("filtered", {}).items():
            if key != "change_when_doubled_um":
                out.near(line["filtered"][key], value, 2 * roughness, f"filtered {key}, {what}")

    def check_points(self, c, want, tol, out):
        """The profile where the file has it: points of the program at the same x"""
        lines = want.get("floor", []) + want.get("wall", [])
        count = len(lines[0]["x_mm"])
        answer = self.run_case("surface", c, c["id"] + "_points",
                               sampling={"samples_per_rev": count})
        if "floor" in want:
            rows = cells(answer.folder / "floor.csv")
            for i, line in enumerate(want["floor"]):
                part = rows[i * count:(i + 1) * count]
                out.all_near([float(r["x_mm"]) for r in part], line["x_mm"], 1e-9, "x of the floor")
                out.all_near([float(r["z_mm"]) for r in part], line["z_mm"], tol["z_mm"],
                             f"floor at {line['y_mm']}")
        if "wall" in want:
            rows = cells(answer.folder / "surface.csv")
            for line in want["wall"]:
                part = [r for r in rows if abs(float(r["height_mm"]) - line["height_mm"]) < 1e-9]
                out.all_near([float(r["error_mm"]) for r in part[:count]], line["z_mm"],
                             tol["z_mm"], f"wall at {line['height_mm']}")


if __name__ == "__main__":
    main(EdgesCases.CASES)
