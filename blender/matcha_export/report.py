"""What the person, or the program that started the export, gets to hear."""

import sys


class ExportError(Exception):
    """The scene cannot be exported; the text is one sentence for the user."""


class Report:
    """Collects warnings, each once, and passes progress on."""

    def __init__(self, show_progress=False, stream=None):
        self.warnings = []
        self.show_progress = show_progress
        self.stream = stream or sys.stdout
        self._last = -1.0

    def progress(self, fraction, stage):
        """`fraction` is 0 to 1 over the whole export."""
        if not self.show_progress or (fraction - self._last < 0.01 and fraction < 1.0):
            return
        self._last = fraction
        print(f"MATCHA progress {fraction:.2f} {stage}", file=self.stream, flush=True)

    def warning(self, text):
        """One line; the same text is said once."""
        text = " ".join(str(text).split())
        if text in self.warnings:
            return
        self.warnings.append(text)
        print(f"MATCHA warning {text}", file=self.stream, flush=True)

    def source(self, path):
        """A file besides the .blend that the export depends on."""
        if self.show_progress:
            print(f"MATCHA source {path}", file=self.stream, flush=True)
