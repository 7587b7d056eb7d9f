"""What holds for every page: it loads without a word on the console and without a network, in the dark and on a phone.

    report_test.py PROGRAM TEST...    runs tests with the built program; without TEST all of them
"""

import os
import subprocess
import sys
import tempfile
import unittest

import browser
from browser import Browser, luminance

PROGRAM = ""


def rawtexel(*words, code=0):
    result = subprocess.run([PROGRAM, *words], capture_output=True, text=True)
    assert result.returncode == code, f"{words}: {result.returncode} {result.stderr}"
    return result.stdout


class ReportTest(unittest.TestCase):
    """Pages are made once a class, into `folder`, by `make`."""

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = cls.temporary.name
        cls.make()
        cls.browser = Browser().__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()
        cls.temporary.cleanup()

    @classmethod
    def path(cls, name):
        return os.path.join(cls.folder, name)

    def expect_silence(self):
        self.assertEqual(self.browser.console(), [])

    def expect_no_network(self):
        kinds = self.browser.run("return [...new Set(performance.getEntriesByType('resource').map(e => e.name.split(':')[0]))];")
        self.assertLessEqual(set(kinds), {"data"})
        self.assertIn("default-src 'none'", self.browser.run("return document.querySelector('meta[http-equiv]').content;"))

    def expect_table(self, table, key, rows, columns):
        """The cells of `table` carry the numbers of `rows`, objects by `key`."""
        cells = self.browser.run(
            """return [...document.querySelectorAll(`#${arguments[0]} tbody tr`)].map(row => Object.fromEntries(
                [...row.cells].map(cell => [cell.dataset.key, {text: cell.textContent, value: cell.dataset.value ?? null}])));""", table)
        self.assertEqual(len(cells), len(rows))
        for row, shown in zip(rows, cells):
            self.assertEqual(shown[key]["text"], str(row[key]))
            for column in columns:
                value = row[column]
                if value is None:
                    self.assertEqual(shown[column]["text"], "–")
                    continue
                self.assertEqual(float(shown[column]["value"]), float(value), f"{row[key]} {column}")
                text = float(shown[column]["text"].replace("\u202f", ""))
                self.assertLessEqual(abs(text - value), 1e-5 * abs(value), f"{row[key]} {column}")

    def expect_dark_mode_and_phone(self, path, name):
        shades = "return [getComputedStyle(document.body).backgroundColor, getComputedStyle(document.body).color];"
        for dark in (False, True):
            self.browser.dark(dark)
            self.browser.open(path)
            ground, ink = (luminance(colour) for colour in self.browser.run(shades))
            self.assertGreater(ink - ground if dark else ground - ink, 0.6)
            self.browser.screenshot(name + ("-dark" if dark else "-light"))
        self.browser.phone()
        self.browser.open(path)
        width = self.browser.run("return document.documentElement.scrollWidth;")
        self.assertLessEqual(width, browser.PHONE_WIDTH, "the page scrolls sideways on a phone")
        self.browser.screenshot(name + "-phone")
        self.browser.emulate("clearDeviceMetricsOverride", {})
        self.browser.dark(False)
        self.expect_silence()


def main(module):
    global PROGRAM
    reason = browser.missing()
    if reason:
        print(f"browser: Skipped\n{reason}")
        sys.exit(browser.SKIPPED)
    PROGRAM = sys.argv.pop(1)
    unittest.main(module=module, verbosity=2)
