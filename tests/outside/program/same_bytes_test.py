"""The same case gives the same bytes, and the case as understood the same answer."""
import json

from in_folder import InFolder, ROOT, main

EXAMPLES = {"st52_slot": "identify", "st52_predict": "simulate", "ball": "simulate",
            "up_milling_runout": "simulate", "plan_next_cut": "plan",
            "plan_wall": "plan"}


class SameBytes(InFolder):
    first = {}

    def answer(self, name, out, case=None, **environment):
        case = case or ROOT / f"examples/{name}/case.toml"
        self.run_program(EXAMPLES[name], case, "-o", out, "-q", **environment)
        return {p.name: p.read_bytes() for p in (self.folder / out).iterdir()}

    def once(self, name):
        """The answer to an example, computed by the test that asks first."""
        if name not in self.first:
            self.first[name] = self.answer(name, f"{name}1")
        return self.first[name]

    def assert_same(self, a, b, name):
        self.assertEqual(sorted(a), sorted(b))
        different = [file for file in a if a[file] != b[file]]
        self.assertEqual(different, [], name)

    def test_twice(self):
        for name in EXAMPLES:
            self.assert_same(self.once(name), self.answer(name, f"{name}2"), name)

    def test_any_number_of_threads(self):
        for name in EXAMPLES:
            for count in ("1", "7"):
                some = self.answer(name, f"{name}{count}_threads", TROCHOID_THREADS=count)
                self.assert_same(self.once(name), some, f"{name}, {count} threads")

    def test_in_any_language_of_the_user(self):
        for language in ("C", "de_DE.UTF-8", "tr_TR.UTF-8"):
            a = self.answer("ball", f"out_{language}", LC_ALL=language, LANG=language)
            self.assert_same(a, self.answer("ball", "out"), language)

    def test_the_case_as_understood_gives_the_same_answer(self):
        """Files are named from another place, so only the numbers are the same."""
        for name in EXAMPLES:
            first = self.once(name)
            case = self.write(f"echo/{name}.toml", first["case.toml"])
            again = self.answer(name, f"{name}2", case)
            for file in first:
                if file.endswith(".csv"):
                    self.assertEqual(first[file], again[file], f"{name} {file}")
            one, two = (json.loads(of["summary.json"]) for of in (first, again))
            for key in ("fits", "chosen", "mean_N", "rms_N", "torque_mean_Nm", "teeth"):
                self.assertEqual(one["result"].get(key), two["result"].get(key), key)

    def test_the_case_as_understood_is_understood_as_it_stands(self):
        for name in ("ball", "up_milling_runout"):
            case = self.write(f"echo/{name}.toml", self.once(name)["case.toml"])
            again = self.answer(name, f"{name}2", case)
            self.assertEqual(self.first[name]["case.toml"], again["case.toml"])


if __name__ == "__main__":
    main()
