#!/usr/bin/python3
"""Makes OUTPUT_DIR/report.html, and its figures, from what a run, a study or a
collection of studies left.

Usage: report.py OUTPUT_DIR

Needs numpy, h5py and matplotlib. The page stands alone: no network, no script.
What a run did not leave is named in the page and left out. Exit status: 0 when
the report was written, 2 for a folder that is none of these, 4 when it could
not be written.
"""
import argparse
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))


def main(arguments=None):
    """Parses the command line, writes the report, returns the exit status."""
    parser = argparse.ArgumentParser(
        description="Makes OUTPUT_DIR/report.html from what a run, a study or "
        "a collection left."
    )
    parser.add_argument(
        "output_dir", type=pathlib.Path, help="its output folder"
    )
    folder = parser.parse_args(arguments).output_dir

    try:
        from morsel_report import collection, page, reader, study
    except ImportError as error:
        print(
            f"The report needs a Python package: {error}. On Debian: apt-get "
            "install python3-numpy python3-h5py python3-matplotlib.",
            file=sys.stderr,
        )
        return 2
    try:
        if (folder / "collection.json").is_file():
            report = collection.write(folder)
        elif (folder / "study.json").is_file():
            report = study.write(folder)
        else:
            report = page.write(reader.Run(folder))
    except reader.NoRun as error:
        print(error, file=sys.stderr)
        return 2
    except OSError as error:
        print(f"Cannot write the report: {error}.", file=sys.stderr)
        return 4
    print(report)
    return 0


if __name__ == "__main__":
    sys.exit(main())
