"""Version, help, the reference page, and every way to use the command line wrongly."""

import re
import shutil
import subprocess

import harness
from harness import BIN, FAILED, ROOT, USAGE, run

COMMANDS = ["import", "info", "calibrate", "reconstruct", "evaluate", "render", "export", "simulate", "demo",
            "batch", "reference"]


def options_in(help_text):
    return re.findall(r"(?m)^  (?:-\w, ?)?(--[\w-]+)", help_text)


class Help(harness.TestCase):
    def test_version_is_printed(self):
        # In a check-out with tag and revision: turnscan 0.1.0 (v0.1.0, 33e5837c-dirty)
        out = self.ok("--version").stdout
        self.assertRegex(out, r"^turnscan \d+\.\d+\.\d+( \(([\w.-]+, )?[0-9a-f]{8,}(-dirty)?\))?\n$")
        self.assertEqual(self.ok("-v").stdout, out)

    def test_help_lists_every_command(self):
        out = self.ok("--help").stdout
        for command in COMMANDS:
            self.assertRegex(out, rf"(?m)^  {command} ")

    def test_help_says_where_the_manual_is(self):
        self.assertIn("The manual is docs/index.md, in the sources.\n", self.ok("--help").stdout)
        self.assertIn("The manual has more in docs/how-to/calibrate.md.", self.ok("calibrate", "--help").stdout)
        program, page = (self.dir / name for name in ("bin/turnscan", "share/doc/turnscan/html/index.html"))
        for made in (program, page):
            made.parent.mkdir(parents=True)
        shutil.copy(BIN, program)
        page.touch()
        told = subprocess.run([program, "--help"], text=True, capture_output=True, check=True).stdout
        self.assertIn(f"The manual is {page}.\n", told)

    def test_every_command_has_help_with_defaults_and_ranges(self):
        for command in COMMANDS:
            out = self.ok(command, "--help-all").stdout
            self.assertIn(f"turnscan {command}", out)
            self.assertIn("--threads NUMBER", out)
            self.assertIn("0 to 1024", out)
        self.assertNotIn("{false}", out)

    def test_help_fits_100_columns(self):
        for command in COMMANDS:
            for way in ("--help", "--help-all"):
                for line in self.ok(command, way).stdout.splitlines():
                    self.assertLessEqual(len(line), 104, line)

    def test_bash_completes_commands_options_and_choices(self):
        script = self.dir / "completion"
        script.write_text(self.ok("reference", "bash").stdout)

        def completed(*words):
            text = f"source {script}; COMP_WORDS=(\"$@\"); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); " \
                   "_turnscan; echo ${COMPREPLY[@]}"
            return subprocess.run(["bash", "-c", text, "bash", "turnscan", *words], text=True,
                                  capture_output=True, check=True).stdout.split()

        self.assertIn("reconstruct", completed("re"))
        self.assertEqual(completed("reconstruct", "--voxel-si"), ["--voxel-size"])
        self.assertEqual(set(completed("reconstruct", "--method", "")),
                         {"volumetric", "poisson", "concave-hull"})
        self.assertEqual(completed("reconstruct", "scan"), [], "files are the shell's own")

    def test_every_option_is_in_the_manual_page_and_in_each_completion(self):
        options = set(re.findall(r"`(?:-\w, )?(--[\w-]+)", self.ok("reference").stdout))
        self.assertGreater(len(options), 100)
        pages = {shell: self.ok("reference", shell).stdout for shell in ("man", "bash", "zsh")}
        for option in options:
            self.assertIn(option.replace("-", "\\-"), pages["man"])
            self.assertIn(option, pages["bash"])
            self.assertIn(option, pages["zsh"])
            self.assertIn(f" -l {option[2:]} ", self.ok_fish())
        self.refused(USAGE, "reference", "tcsh", says="FORMAT")

    def ok_fish(self):
        if not hasattr(self, "fish"):
            self.fish = self.ok("reference", "fish").stdout
        return self.fish

    def test_the_reference_page_in_docs_is_what_the_program_prints(self):
        page = (ROOT / "docs" / "reference" / "options.md").read_text()
        self.assertEqual(page, self.ok("reference").stdout,
                         "run: turnscan reference > docs/reference/options.md")

    def test_option_names_are_unique_within_a_command(self):
        for command in COMMANDS:
            names = options_in(self.ok(command, "--help-all").stdout)
            self.assertEqual(len(names), len(set(names)), f"{command}: {names}")

    def commands(self):
        """Every command, with its options as the reference page has them."""
        page = self.ok("reference").stdout
        sections = re.findall(r"(?ms)^## turnscan (\S+)$(.*?)(?=^## |\Z)", page)
        return {name: re.findall(r"(?m)^\| `(?:-\w, )?(--[\w-]+)", text) for name, text in sections}

    def test_help_shows_at_most_twelve_options_on_a_screen_and_help_all_every_one(self):
        commands = self.commands()
        self.assertGreaterEqual(set(commands), set(COMMANDS))
        for command, options in commands.items():
            out = self.ok(command, "--help").stdout
            common = [o for o in options_in(out) if o not in ("--help", "--help-all")]
            self.assertLessEqual(len(common), 12, command)
            self.assertLessEqual(out.count("\n"), 60, command)
            self.assertIn(f"'turnscan {command} --help-all' explains all {len(options)} options", out)
            self.assertLessEqual(set(common), set(options), command)
            everything = options_in(self.ok(command, "--help-all").stdout)
            self.assertEqual(sorted(everything), sorted([*options, "--help", "--help-all"]), command)
            if len(options) > 12:
                self.assertGreaterEqual(len(common), 8, command)

    def test_help_goes_by_importance(self):
        shown = options_in(self.ok("reconstruct", "--help").stdout)
        self.assertEqual(shown[:2], ["--out", "--triangles"])
        self.assertNotIn("--pass-pose", shown)
        self.assertEqual(options_in(self.ok("scan", "--help").stdout)[:2], ["--device", "--out"])

    def test_help_can_be_asked_for_in_several_ways(self):
        for command in COMMANDS:
            out = self.ok(command, "--help").stdout
            self.assertEqual(self.ok(command, "-h").stdout, out)
            self.assertEqual(self.ok("help", command).stdout, out)
        self.assertEqual(self.ok("help").stdout, self.ok("--help").stdout)
        self.refused(USAGE, "help", "reconstrct", says="there is no such command")


class WrongUsage(harness.TestCase):
    def wrong(self, *args, says=()):
        result = run(*args, cwd=self.dir)
        self.assertEqual(result.returncode, USAGE, f"{args}: {result.stderr}")
        self.assertEqual(result.stdout, "")
        self.assert_one_line_error(result.stderr, args)
        self.assertIn("--help'", result.stderr)
        for words in (says,) if isinstance(says, str) else says:
            self.assertIn(words, result.stderr)

    def test_no_command(self):
        self.wrong()

    def test_unknown_command(self):
        self.wrong("reconstrct", says=["reconstrct: ", "did you mean 'reconstruct'"])
        self.wrong("wobblegong", says=["wobblegong: ", "use one of", "reconstruct"])

    def test_unknown_option_names_the_nearest(self):
        self.wrong("reconstruct", "rec", "-o", "m.ply", "--voxl-size", "1mm", says="--voxel-size")
        self.wrong("--verson", says="--version")

    def test_a_mistyped_option_is_named_before_what_is_missing(self):
        self.wrong("reconstruct", "--voxl-size", "1mm", says="did you mean '--voxel-size'")
        self.wrong("import", "scans", "--formt", "tum", says="did you mean '--format'")

    def test_an_option_that_is_far_from_all_is_not_guessed(self):
        result = harness.run("reconstruct", "rec", "-o", "m.ply", "--frames", "3")
        self.assertNotIn("did you mean", result.stderr)
        self.assertIn("it belongs to", result.stderr)
        self.assertIn("capture", result.stderr)
        result = harness.run("reconstruct", "rec", "-o", "m.ply", "--wobblegong", "3")
        self.assertNotIn("did you mean", result.stderr)
        self.assertNotIn("belongs", result.stderr)

    def test_one_argument_too_many(self):
        self.wrong("info", "a.ply", "b.ply", says="b.ply")

    def test_missing_argument(self):
        self.wrong("reconstruct", "-o", "m.ply", says="RECORDING")
        self.wrong("reconstruct", "rec", says="--out")
        self.wrong("info", says="RECORDING")
        self.wrong("import", "-o", "rec", says="SOURCE")
        self.wrong("import", "scans", says="--out")

    def test_missing_value(self):
        self.wrong("reconstruct", "rec", "-o", "m.ply", "--voxel-size", says="--voxel-size")

    def test_number_without_its_unit(self):
        self.wrong("reconstruct", "rec", "-o", "m.ply", "--voxel-size", "1.5",
                   says=["voxel-size", "unit", "mm"])

    def test_unknown_unit(self):
        self.wrong("reconstruct", "rec", "-o", "m.ply", "--voxel-size", "1.5parsec",
                   says=["parsec", "mm"])

    def test_value_out_of_range_names_the_range(self):
        self.wrong("reconstruct", "rec", "-o", "m.ply", "--threads", "-1", says=["threads", "1024"])
        self.wrong("demo", "--frames", "0", says="frames")

    def test_not_a_number(self):
        for text in ("nan", "inf", "1e999", "0x10", "1,5", ""):
            self.wrong("demo", "--frames", text, says="frames")

    def test_whole_numbers_only(self):
        self.wrong("demo", "--frames", "60.5", says="whole number")

    def test_unknown_choice_lists_the_choices(self):
        self.wrong("reconstruct", "rec", "-o", "m.ply", "--candidates", "best", says="sub-voxel")

    def test_unknown_output_format(self):
        self.wrong("reconstruct", "rec", "-o", "m.docx", says=["m.docx", ".ply"])
        self.wrong("render", "m.ply", "-o", "m.bmp", says=".png")

    def test_unknown_stage(self):
        self.wrong("reconstruct", "rec", "-o", "m.ply", "--save-stage", "crob", says="merged")

    def test_unknown_object(self):
        self.wrong("demo", "--object", "teapot", says="doll")


class ConfigFile(harness.TestCase):
    def wrong(self, toml, says, code=USAGE):
        (self.dir / "o.toml").write_text(toml)
        self.refused(code, "reconstruct", "rec", "-o", "m.ply", "--config", "o.toml", says=says)

    def test_unknown_key_names_file_line_and_nearest_option(self):
        self.wrong("\n\nvoxel-siz = '1mm'\n", ["o.toml:3", "'voxel-size'"])

    def test_unknown_table_lists_the_tables(self):
        self.wrong("[voxel]\nvoxel-size = '1mm'\n", ["o.toml:1", "[voxels]"])

    def test_key_in_the_wrong_table_names_the_right_one(self):
        self.wrong("[outliers]\nvoxel-size = '1mm'\n", ["o.toml:2", "[voxels]"])

    def test_number_without_its_unit(self):
        self.wrong("voxel-size = 1.5\n", ["o.toml:1", "unit"])

    def test_value_that_is_no_value(self):
        self.wrong("threads = [1, 2]\n", ["o.toml:1", "threads"])
        self.wrong("threads = 1979-05-27\n", ["o.toml:1", "threads"])

    def test_value_out_of_range(self):
        self.wrong("[run]\nthreads = -3\n", ["o.toml:2", "1024"])
        self.wrong("threads = nan\n", ["o.toml:1", "threads"])

    def test_text_that_is_not_toml(self):
        self.wrong("a = = b\n", ["o.toml:1"])
        self.wrong("a = 1\na = 2\n", ["o.toml"])
        self.wrong("\0\xff", ["o.toml"])

    def test_missing_file(self):
        self.refused(FAILED, "reconstruct", "rec", "-o", "m.ply", "--config", "none.toml",
                     says="none.toml")

    def test_a_folder_is_not_a_file(self):
        self.refused(USAGE, "reconstruct", "rec", "-o", "m.ply", "--config", ".", says="TOML")


class Output(harness.TestCase):
    def test_full_standard_output_is_a_failure(self):
        with open("/dev/full", "w") as full:
            result = run("reference", cwd=self.dir, stdout=full)
        self.assertEqual(result.returncode, FAILED)
        self.assert_one_line_error(result.stderr)

    def test_a_closed_or_full_standard_error_changes_nothing(self):
        with open("/dev/full", "w") as full:
            self.assertEqual(run("reference", cwd=self.dir, stderr=full).returncode, 0)
            self.assertEqual(run("--nonsense", cwd=self.dir, stderr=full).returncode, USAGE)


if __name__ == "__main__":
    harness.main()
