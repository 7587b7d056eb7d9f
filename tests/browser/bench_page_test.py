"""The page of `rawtexel bench` in a real browser."""

import csv
import glob
import json

import report_test
from browser import KEYS
from report_test import ReportTest, rawtexel


class BenchPage(ReportTest):
    @classmethod
    def make(cls):
        cls.out = cls.path("out")
        rawtexel("bench", "metal-edge", "magnify", "-o", cls.out, "--size", "32x20", "--light", "0.2,-0.3,-1,3", "--environment", "none", "--progress",
                 "never", "--mip", "none,linear", "--hybrid-bias", "none,1,2", "--estimator", "all,reservoir", "--spp", "1,4,16", "--reference", "0.01",
                 "--repeat", "2")
        cls.page = cls.out + "/index.html"
        with open(cls.out + "/bench.json") as file:
            cls.json = json.load(file)

    def setUp(self):
        self.browser.open(self.page)

    def tearDown(self):
        self.expect_silence()

    def of(self, scene):
        return [one for one in self.json["configurations"] if one["scene"] == scene]

    def choose(self, select, value):
        self.browser.run("""const select = document.getElementById(arguments[0]);
            select.value = arguments[1];
            select.dispatchEvent(new Event('change'));""", select, value)

    def tags(self):
        return self.browser.run("return [...document.querySelectorAll('.tag')].map(tag => tag.textContent);")

    def name(self, one):
        count = one["image"]["spp"]
        return f"{one['filter']} · {one['minification']} · {one['estimator']} · {one['order']}, {count} sample{'' if count == 1 else 's'}"

    def points(self, kind, filter):
        """The plot's points: the configuration's number, what its title says, and whether it is hollow."""
        return self.browser.run("""const host = document.querySelector(`#plots [data-kind="${arguments[0]}"][data-filter="${arguments[1]}"]`);
            return [...host.shadowRoot.querySelectorAll('circle[data-key]')].map(c => [Number(c.dataset.key), c.querySelector('title').textContent,
                c.getAttribute('fill') === '#fff']);""", kind, filter)

    def test_loads_without_network(self):
        self.expect_no_network()
        self.assertEqual(self.browser.run("return document.querySelector('.command').textContent;"), self.json["command"])

    def expect_configurations(self, configurations):
        paths = {"spp": "image.spp", "frame_s": "frame_s.median", "spread": "frame_s.spread", "geometry": "time_s.geometry", "raster": "time_s.raster",
                 "shade": "time_s.shade"}
        rows = []
        for one in configurations:
            row = {"setting": self.name(one).rsplit(",", 1)[0]}
            for key in ("spp", "rmse", "relmse", "psnr", "flip", "frame_s", "spread", "geometry", "raster", "shade", "texels_per_pixel", "lines_per_pixel"):
                value = one
                for part in paths.get(key, key).split("."):
                    value = value[part]
                row[key] = value
            rows.append(row)
        self.expect_table("configurations", "setting", rows, [key for key in rows[0] if key != "setting"])

    def test_tables_equal_the_json(self):
        for scene in self.json["scenes"]:
            self.choose("scene", scene["scene"])
            self.browser.wait(f"document.body.dataset.scene === '{scene['scene']}'")
            self.expect_configurations(self.of(scene["scene"]))
            self.expect_table("series", "name", scene["series"], ["slope", "bias"])
            self.expect_table("truths", "filter", scene["truths"], ["spp", "standard_error", "goal", "seconds"])
            reasons = self.browser.run("return [...document.querySelectorAll('#left-out td[data-key=reason]')].map(cell => cell.textContent);")
            self.assertEqual(reasons, [one["reason"] for one in scene["left_out"]])
            self.assertTrue(reasons)

    def test_page_json_and_csv_have_the_same_numbers(self):
        with open(self.out + "/bench.csv", newline="") as file:
            lines = list(csv.DictReader(file))
        shown = self.browser.run("return data.configurations;")
        self.assertEqual(len(lines), len(self.json["configurations"]))
        for line, one, page in zip(lines, self.json["configurations"], shown):
            page.pop("source")
            self.assertEqual(page, one)
            for key in ("rmse", "relmse", "flip", "texels_per_pixel", "lines_per_pixel"):
                self.assertEqual(float(line[key]), one[key])
            self.assertEqual(float(line["frame_s_median"]), one["frame_s"]["median"])

    def test_findings_are_those_of_the_json(self):
        for filter in ("bilinear", "bspline"):
            self.choose("glance-filter", filter)
            for scene in self.json["scenes"]:
                shown = self.browser.run("return [...document.querySelectorAll(`article[data-scene=\"${arguments[0]}\"] .findings li`)].map(li => li.textContent);",
                                         scene["scene"])
                expected = [finding["text"] for finding in scene["findings"] if finding["filter"] == filter]
                self.assertEqual(shown, expected)
                self.assertGreaterEqual(len(expected), 3)
        self.assertGreater(self.browser.run("return document.querySelectorAll('.findings strong').length;"), 0)

    def test_fronts(self):
        self.browser.click("#show-front")
        expected = [one for one in self.of("metal-edge") if one["front_time"] or one["front_fetches"]]
        self.expect_configurations(expected)
        marks = self.browser.run("return [...document.querySelectorAll('#configurations td[data-key=front]')].map(cell => cell.textContent);")
        self.assertEqual(marks, [", ".join(name for name in ("time", "fetches") if one["front_" + name]) for one in expected])
        self.browser.click("#show-all")
        self.expect_configurations(self.of("metal-edge"))

    def test_plots_hold_their_configurations(self):
        for filter in ("bilinear", "bspline"):
            self.choose("filter", filter)
            plain = [i for i, one in enumerate(self.json["configurations"])
                     if one["scene"] == "metal-edge" and one["filter"] == filter and one["hybrid_bias"] is None]
            for kind in ("error-samples", "error-time", "error-fetches", "time-samples"):
                points = self.points(kind, filter)
                self.assertEqual(sorted(key for key, _, _ in points), plain, kind)
                for key, title, hollow in points:
                    one = self.json["configurations"][key]
                    self.assertIn(f"RMSE {one['rmse']:.6g}, {one['frame_s']['median'] * 1e3:.6g} ms, {one['texels_per_pixel']:.6g} texels", title)
                    self.assertEqual(hollow, not one["clear"])
            bias = self.points("bias-hybrid", filter)
            self.assertGreaterEqual(len(bias), 4)
        self.choose("filter", "")
        self.assertTrue(self.points("error-fetches", ""))
        names = {path.rsplit("/", 1)[1] for path in glob.glob(self.out + "/plots/*.svg")}
        self.assertLessEqual({"magnify_bspline_error-samples.svg", "metal-edge_bilinear_bias-hybrid.svg", "metal-edge_kernels_error-time.svg"}, names)

    def test_a_plot_speaks_under_the_pointer_and_takes_a_click(self):
        box = self.browser.run("""const host = document.querySelector('#plots [data-kind="error-samples"]');
            host.scrollIntoView({block: 'center'});
            const circle = [...host.shadowRoot.querySelectorAll('circle[data-key]')].at(-1), box = circle.getBoundingClientRect();
            const own = host.getBoundingClientRect();
            return [box.left + box.width / 2 - own.left, box.top + box.height / 2 - own.top, Number(circle.dataset.key), circle.querySelector('title').textContent];""")
        self.browser.hover("#plots [data-kind='error-samples']", box[0], box[1])
        self.browser.wait("document.getElementById('point').textContent !== ''")
        self.assertEqual(self.browser.run("return document.getElementById('point').textContent;"), box[3])
        self.browser.run("""[...document.querySelector('#plots [data-kind="error-samples"]').shadowRoot.querySelectorAll('circle[data-key]')].at(-1)
            .dispatchEvent(new MouseEvent('click', {bubbles: true}));""")
        one = self.json["configurations"][box[2]]
        self.browser.wait(f"document.body.dataset.left === '{self.name(one)}'")
        self.assertEqual(self.tags(), [self.name(one), f"truth, {one['filter']}"])
        self.assertIn(one["command"], self.browser.run("return document.getElementById('picture-command').textContent;"))

    def test_a_plot_is_walked_by_the_keyboard(self):
        self.browser.run("document.querySelector('#plots [data-kind=\"error-fetches\"]').focus();")
        points = self.points("error-fetches", "bilinear")
        plot = "#plots [data-kind='error-fetches']"
        self.browser.type(plot, KEYS["right"] * 3)
        self.assertEqual(self.browser.run("return document.getElementById('point').textContent;"), points[2][1])
        self.browser.type(plot, KEYS["left"])
        self.assertEqual(self.browser.run("return document.getElementById('point').textContent;"), points[1][1])
        self.browser.type(plot, "\ue007")
        self.browser.wait(f"document.body.dataset.left === '{self.name(self.json['configurations'][points[1][0]])}'")

    def test_costs_at_an_error_lie_between_the_points(self):
        series = next(s for s in self.json["scenes"][0]["series"] if len(s["configurations"]) == 3 and s["slope"] is not None and s["slope"] < -0.3)
        first, second = (self.json["configurations"][i] for i in series["configurations"][:2])
        error = (first["rmse"] * second["rmse"]) ** 0.5
        self.browser.run("""const input = document.getElementById('reach');
            input.value = arguments[0];
            input.dispatchEvent(new Event('input'));""", repr(error))
        rows = self.browser.run("""return [...document.querySelectorAll('#reached tbody tr')].map(row => Object.fromEntries(
            [...row.cells].map(cell => [cell.dataset.key, cell.dataset.value ?? cell.textContent])));""")
        shown = next(row for row in rows if row["name"] == series["name"])
        # Half way of the logarithms: the geometric mean.
        self.assertAlmostEqual(float(shown["texels"]), (first["texels_per_pixel"] * second["texels_per_pixel"]) ** 0.5, delta=1e-6)
        self.assertAlmostEqual(float(shown["samples"]), (first["image"]["spp"] * second["image"]["spp"]) ** 0.5, delta=1e-6)
        names = {row["name"] for row in rows}
        for s in self.json["scenes"][0]["series"]:
            reaches = any(self.json["configurations"][i]["rmse"] <= error for i in s["configurations"])
            self.assertEqual(s["name"] in names, reaches, s["name"])

    def test_slider_and_keys(self):
        self.browser.run("document.querySelector('#pictures').scrollIntoView({block: 'center'});")
        width = self.browser.run("return document.querySelector('.stage').getBoundingClientRect().width;")
        self.browser.hover(".stage", width / 4, 20)
        self.assertAlmostEqual(self.browser.run("return slider.position;"), 25, delta=1)
        text = self.browser.run("return document.querySelector('#pictures .readout').textContent;")
        self.assertRegex(text, r"^pixel [789], \d+\n")
        self.browser.run("document.querySelector('.slider').focus();")
        at = self.browser.run("return slider.position;")
        self.browser.type(".slider", KEYS["right"] * 2)
        self.assertAlmostEqual(self.browser.run("return slider.position;"), at + 2, places=6)
        left, right = self.tags()
        self.browser.type("body", "s")
        self.browser.wait(f"document.querySelector('.tag.left').textContent === '{right}'")
        self.assertEqual(self.tags(), [right, left])
        self.browser.type("body", "n")
        self.browser.wait("document.querySelector('.tag.left').textContent === 'truth, bspline'")
        self.browser.type("body", "z")
        self.assertEqual(self.browser.run("return document.querySelector('.stage').getBoundingClientRect().width;"), 32)

    def test_pictures_are_those_of_render(self):
        one = self.of("magnify")[-1]
        words = one["command"].split(" ")
        words[words.index("-o") + 1] = self.path("again.png")
        rawtexel(*words[1:], "--progress", "never")
        rawtexel("texture", "decode", self.path("again.png"), "-o", self.path("again.tga"))
        self.choose("scene", "magnify")
        self.browser.wait("document.body.dataset.scene === 'magnify'")
        self.choose("left", self.name(one))
        self.browser.wait(f"document.body.dataset.left === '{self.name(one)}'")
        with open(self.path("again.tga"), "rb") as file:
            header = file.read(18)
            texels = file.read()
        size, upside_down = header[16] // 8, not header[17] & 0x20
        self.assertEqual(header[2], 2, "uncompressed")
        for x, y in ((0, 0), (31, 19), (7, 12)):
            start = ((19 - y if upside_down else y) * 32 + x) * size
            self.assertEqual(self.browser.run("return slider.codes('left', ...arguments);", x, y), list(texels[start:start + 3][::-1]))

    def test_every_control_is_reached_by_tab(self):
        reached = set()
        for _ in range(120):
            self.browser.ask("POST", "/actions", {"actions": [{"type": "key", "id": "keyboard", "actions": [
                {"type": "keyDown", "value": KEYS["tab"]}, {"type": "keyUp", "value": KEYS["tab"]}]}]})
            reached.add(self.browser.run("const e = document.activeElement; return e.id || e.dataset.kind || e.classList[0];"))
        self.assertLessEqual({"glance-filter", "scene", "filter", "left", "right", "zoom", "swap", "slider", "slider-position", "show-all", "show-front", "reach",
                              "error-samples", "error-time", "error-fetches", "time-samples", "bias-hybrid"}, reached)

    def test_dark_mode_and_phone(self):
        self.expect_dark_mode_and_phone(self.page, "bench")


if __name__ == "__main__":
    report_test.main("__main__")
