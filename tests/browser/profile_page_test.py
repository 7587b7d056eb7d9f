"""The page of `rawtexel profile` in a real browser."""

import csv
import json

import report_test
from browser import KEYS
from report_test import ReportTest, rawtexel


class ProfilePage(ReportTest):
    @classmethod
    def make(cls):
        cls.out = cls.path("out")
        rawtexel("profile", "metal-edge", "-o", cls.out, "--size", "96x64", "--crop", "20,10,64,40", "--spp", "40", "--progress", "never",
                 "--compare-with", "--filter nearest --mip nearest", "--compare-with", "--estimator reservoir")
        cls.page = cls.out + "/index.html"
        with open(cls.out + "/profile.json") as file:
            cls.json = json.load(file)

    def setUp(self):
        self.browser.open(self.page)
        self.browser.wait("document.body.dataset.readout === 'yes'")

    def tearDown(self):
        self.expect_silence()

    def layer(self, setting, name):
        return self.browser.run("return [...settled.get(`${arguments[0]} ${arguments[1]}`)];", setting, name)

    def choose(self, select, value):
        self.browser.run("""const select = document.getElementById(arguments[0]);
            select.value = arguments[1];
            select.dispatchEvent(new Event('change'));""", select, value)

    def test_loads_without_network(self):
        self.expect_no_network()
        text = self.browser.run("return document.querySelector('.command').textContent;")
        self.assertEqual(text, self.json["command"])

    def test_maps_sum_to_the_counters(self):
        for setting, numbers in enumerate([self.json, *self.json["compare_with"]]):
            texture = numbers["texture"]
            self.assertEqual(sum(self.layer(setting, "texels_requested")), texture["texels_requested"])
            self.assertEqual(sum(self.layer(setting, "lines_first")), texture["lines_64"])
            self.assertEqual(sum(self.layer(setting, "blocks_first")), texture["blocks_touched"])
            self.assertEqual(sum(self.layer(setting, "l1_miss")), texture["cache"]["l1_misses"])
            self.assertEqual(sum(self.layer(setting, "l2_miss")), texture["cache"]["l2_misses"])

    def test_hover_reads_the_pixel_in_the_whole_image(self):
        box = self.browser.run("const b = document.querySelector('.stage').getBoundingClientRect(); return [b.width, b.height];")
        self.browser.hover(".stage", box[0] * 0.5, box[1] * 0.5)
        text = self.browser.run("return document.querySelector('.readout').textContent;")
        self.assertRegex(text, r"^pixel 5[1-3], (29|30|31)\n")
        x, y = (int(part) for part in text.split("\n")[0].removeprefix("pixel ").split(","))
        at = (y - 10) * 64 + x - 20
        self.assertIn(f"as profiled: texels_requested {self.layer(0, 'texels_requested')[at]:g} ", text)
        self.assertIn(f"nearest: texels_requested {self.layer(1, 'texels_requested')[at]:g} ", text)

    def test_maps_show_their_numbers_in_the_colours_of_the_legend(self):
        self.choose("left-layer", "texels_requested")
        self.browser.wait("document.body.dataset.leftLayer === '0 texels_requested'")
        values = self.layer(0, "texels_requested")
        most = max(max(self.layer(setting, "texels_requested")) for setting in range(3))
        at = values.index(max(values))
        shown = self.browser.run("return slider.codes('left', ...arguments);", at % 64, at // 64)
        colour = round(values[at] * 255 / most)
        self.assertEqual(shown, self.browser.run("return [...mapColours.slice(arguments[0] * 3, arguments[0] * 3 + 3)];", colour))
        ends = self.browser.run("return [...document.querySelectorAll('#legend-left [data-value]')].map(end => Number(end.dataset.value));")
        self.assertEqual(ends, [0, most])

    def test_models_stand_beside_each_other(self):
        models = self.json["models"]
        self.assertEqual(list(models), ["visible", "forward", "quad"])
        rows = [{"counter": key, **{model: models[model][key] for model in models}} for key in ("lookups", "taps", "texels_requested")]
        shown = self.browser.run("""return [...document.querySelectorAll('#models tbody tr')].map(row => Object.fromEntries(
            [...row.cells].map(cell => [cell.dataset.key, cell.dataset.value ?? cell.textContent])));""")
        for row in rows:
            found = next(line for line in shown if line["counter"] == row["counter"])
            for model in models:
                self.assertEqual(float(found[model]), row[model])
        self.assertGreater(models["quad"]["lookups"], models["visible"]["lookups"])

    def test_settings_tell_their_differences(self):
        shown = self.browser.run("""return [...document.querySelectorAll('#settings tbody tr')].map(row => [...row.cells].map(cell => cell.textContent));""")
        texels = next(line for line in shown if line[0] == "texels_requested")
        own, nearest = self.json["texture"]["texels_requested"], self.json["compare_with"][0]["texture"]["texels_requested"]
        self.assertLess(nearest, own)
        self.assertEqual(texels[3], f"−{float(f'{(1 - nearest / own) * 100:.3g}'):g} %")

    def test_textures_equal_the_csv_by_level(self):
        self.browser.click("#levels")
        shown = self.browser.run("""return [...document.querySelectorAll('#textures tbody tr')].map(row => Object.fromEntries(
            [...row.cells].map(cell => [cell.dataset.key, cell.dataset.value ?? cell.textContent])));""")
        with open(self.out + "/textures.csv") as file:
            lines = list(csv.DictReader(file))
        self.assertEqual(len(shown), len(lines))
        expected = {(line["texture"], line["level"]): line for line in lines}
        for row in shown:
            line = expected[row["name"], row["level"]]
            for key in ("texels_requested", "texels_unique", "blocks_touched", "lines_64", "bytes_decoded", "bytes_stored"):
                self.assertEqual(row[key], line[key], f"{row['name']} {row['level']} {key}")

    def test_histograms_sum_to_the_lookups(self):
        sums = "return [...document.querySelectorAll('#histograms svg')].map(plot => [...plot.querySelectorAll('rect')].reduce((sum, bar) => sum + Number(bar.dataset.count), 0));"
        self.assertEqual(self.browser.run(sums), [self.json["texture"]["lookups"]] * 3)

    def test_residency_shows_the_blocks_touched(self):
        pictures = self.browser.run("return [...document.querySelectorAll('#residency img')].map(image => [image.complete, image.naturalWidth, image.width]);")
        touched = [texture for texture in self.json["textures"] if texture["blocks_touched"] > 0]
        self.assertEqual(len(pictures), len(touched))
        self.assertTrue(all(complete and natural > 0 for complete, natural, _ in pictures))
        text = self.browser.run("return document.getElementById('residency').textContent.replaceAll('\\u202f', '');")
        for texture in touched:
            self.assertIn(f"{texture['blocks_touched']} of ", text)

    def test_keyboard_goes_through_maps(self):
        self.browser.type("body", "m")
        self.browser.wait("document.body.dataset.rightLayer === '1 lines_pixel'")
        self.browser.run("document.querySelector('.slider').focus();")
        self.browser.type(".slider", KEYS["end"])
        self.assertEqual(self.browser.run("return slider.position;"), 100)

    def test_dark_mode_and_phone(self):
        self.expect_dark_mode_and_phone(self.page, "profile")


if __name__ == "__main__":
    report_test.main("__main__")
