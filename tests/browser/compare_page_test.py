"""The page of `rawtexel compare --html` in a real browser."""

import json

import report_test
from browser import KEYS
from report_test import ReportTest, rawtexel


class ComparePage(ReportTest):
    @classmethod
    def make(cls):
        size = ["--size", "160x90", "--progress", "never"]
        rawtexel("render", "magnify", "-o", cls.path("nearest.png"), "--filter", "nearest", "--mip", "none", *size)
        rawtexel("render", "magnify", "-o", cls.path("bilinear.png"), "--filter", "bilinear", "--mip", "none", *size)
        rawtexel("render", "magnify", "-o", cls.path("b-spline.png"), "--filter", "bspline", "--mip", "none", *size)
        paths = [cls.path(name) for name in ("nearest.png", "bilinear.png", "b-spline.png", "bilinear.png")]
        cls.page = cls.path("compare.html")
        cls.json = json.loads(rawtexel("compare", *paths, "--html", cls.page, "--json"))

    def setUp(self):
        self.browser.open(self.page)

    def tearDown(self):
        self.expect_silence()

    def split(self):
        return self.browser.run("return slider.position;")

    def tags(self):
        return self.browser.run("return [...document.querySelectorAll('.tag')].map(tag => tag.textContent.split('/').pop());")

    def codes(self, side, x, y):
        return self.browser.run("return slider.codes(...arguments);", side, x, y)

    def test_loads_without_network(self):
        self.expect_no_network()

    def test_table_equals_json(self):
        columns = ["mse", "rmse", "psnr", "relmse", "max", "mean", "flip", "flip_q1", "flip_median", "flip_q3", "flip_min", "flip_max"]
        self.assertIsNone(self.json["images"][2]["psnr"])
        self.expect_table("figures", "image", self.json["images"], columns)

    def test_table_sorts(self):
        self.browser.click("#figures th[data-key=rmse] button")
        values = "return [...document.querySelectorAll('#figures td[data-key=rmse]')].map(cell => Number(cell.dataset.value));"
        ascending = self.browser.run(values)
        self.assertEqual(ascending, sorted(ascending))
        self.browser.click("#figures th[data-key=rmse] button")
        self.assertEqual(self.browser.run(values), sorted(ascending, reverse=True))

    def test_mouse_moves_the_line_and_reads_pixels(self):
        width = self.browser.run("return document.querySelector('.stage').getBoundingClientRect().width;")
        self.browser.hover(".stage", width / 4, 20)
        self.assertAlmostEqual(self.split(), 25, delta=0.5)
        text = self.browser.run("return document.querySelector('.readout').textContent;")
        self.assertRegex(text, r"^pixel (39|40|41), \d+\n")
        x, y = (int(part) for part in text.split("\n")[0].removeprefix("pixel ").split(","))
        for side in ("left", "right"):
            self.assertIn(" ".join(str(code) for code in self.codes(side, x, y)), text)

    def test_pictures_are_those_compared(self):
        # The largest difference of what the page shows is the largest of the figures.
        differences = """
            const pixels = side => slider[side].getContext('2d').getImageData(0, 0, slider.width, slider.height).data;
            const a = pixels('left'), b = pixels('right');
            let most = 0;
            a.forEach((code, i) => { most = Math.max(most, Math.abs(code - b[i])); });
            return most;"""
        self.assertEqual(self.browser.run(differences), round(self.json["images"][0]["max"] * 255))

    def test_keyboard(self):
        self.browser.run("document.querySelector('.slider').focus();")
        self.browser.type(".slider", KEYS["right"])
        self.assertEqual(self.split(), 51)
        self.browser.type(".slider", KEYS["left"] * 3)
        self.assertEqual(self.split(), 48)
        self.browser.type(".slider", KEYS["end"])
        self.assertEqual(self.split(), 100)
        self.browser.type(".slider", KEYS["home"])
        self.assertEqual(self.split(), 0)
        self.browser.type(".slider-position", KEYS["right"])
        self.assertEqual(self.split(), 0.5)
        self.assertEqual(self.tags(), ["nearest.png", "bilinear.png"])
        self.browser.type("body", "s")
        self.assertEqual(self.tags(), ["bilinear.png", "nearest.png"])
        self.browser.type("body", "3")
        self.browser.wait("document.querySelector('.tag.left').textContent.endsWith('b-spline.png')")

    def test_every_control_is_reached_by_tab(self):
        reached = set()
        for _ in range(40):
            self.browser.ask("POST", "/actions", {"actions": [{"type": "key", "id": "keyboard", "actions": [
                {"type": "keyDown", "value": KEYS["tab"]}, {"type": "keyUp", "value": KEYS["tab"]}]}]})
            reached.add(self.browser.run("const e = document.activeElement; return e.id || e.dataset.view || e.classList[0];"))
        self.assertLessEqual({"left", "right", "zoom", "swap", "alternate", "picture", "absolute", "flip", "slider", "slider-position"}, reached)

    def test_maps(self):
        self.browser.click("[data-view=flip]")
        self.browser.wait("document.body.dataset.view === 'flip'")
        self.assertEqual(self.tags()[0], "nearest.png: FLIP")
        ends = "return [...document.querySelectorAll('.legend [data-value]')].map(end => Number(end.dataset.value));"
        self.assertEqual(self.browser.run(ends), [0, 1])
        self.browser.type("body", "mm")
        self.browser.wait("document.body.dataset.view === 'absolute'")
        self.assertEqual(self.browser.run(ends), [0, max(image["max"] for image in self.json["images"])])
        # Beside an image that equals the reference the map is black, which magma shows as 0 0 4.
        self.browser.type("body", "4")
        self.browser.wait("document.querySelector('.tag.left').textContent.endsWith('bilinear.png: Absolute difference')")
        self.assertEqual(self.codes("left", 80, 45), [0, 0, 4])

    def test_zoom(self):
        for scale in (1, 2, 4, 8):
            self.browser.type("body", "z")
            self.assertEqual(self.browser.run("return document.querySelector('.stage').getBoundingClientRect().width;"), 160 * scale)

    def test_alternates(self):
        self.browser.click("#alternate")
        self.browser.wait("slider.position === 0 || slider.position === 100")
        self.browser.wait("slider.position === 0")
        self.browser.wait("slider.position === 100")
        self.browser.click("#alternate")
        self.assertEqual(self.split(), 50)

    def test_dark_mode_and_phone(self):
        self.expect_dark_mode_and_phone(self.page, "compare")


if __name__ == "__main__":
    report_test.main("__main__")
