"""Exports a .blend file as .glb with the MATCHA_cycles extension.

    python export_cli.py scene.blend out.glb [--progress]            (a Python with bpy)
    blender -b scene.blend --python export_cli.py -- out.glb [--progress]

Lines on stdout that start with "MATCHA progress", "MATCHA warning" or "MATCHA source" (a texture or
library that the export depends on) are for programs; on failure
one sentence, "MATCHA error ...", goes to stderr and the exit code is 2.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))


def arguments(argv):
    """(.blend path or None, .glb path, progress) or None where the command line makes no sense."""
    inside_blender = "--" in argv
    words = argv[argv.index("--") + 1 :] if inside_blender else argv[1:]
    paths = [word for word in words if not word.startswith("--")]
    if any(word.startswith("--") and word != "--progress" for word in words):
        return None
    if len(paths) != (1 if inside_blender else 2):
        return None
    return (None, *paths, "--progress" in words) if inside_blender else (*paths, "--progress" in words)


def open_blend(bpy, path):
    """Loads the file; Blender's own message otherwise becomes one sentence."""
    from matcha_export.report import ExportError

    if not os.path.isfile(path):
        raise ExportError(f"{path}: there is no such file.")
    try:
        bpy.ops.wm.open_mainfile(filepath=os.path.abspath(path), load_ui=False)
    except RuntimeError as error:
        raise ExportError(f"{path}: Blender cannot open this file.") from error


def run(argv):
    """Exit code and error sentence."""
    asked = arguments(argv)
    if asked is None:
        return 2, "usage: export_cli.py scene.blend out.glb [--progress]"
    blend, out, progress = asked
    try:
        import bpy
    except ImportError:
        return 2, "This Python has no module bpy; run the script in Blender or install bpy."
    from matcha_export import scene
    from matcha_export.report import ExportError, Report

    try:
        if blend is not None:
            open_blend(bpy, blend)
        elif not bpy.data.filepath:
            raise ExportError("Blender could not open the scene file.")
        scene.export(os.path.abspath(out), Report(progress))
    except ExportError as error:
        return 2, str(error)
    except Exception as error:  # a fault of the exporter: still one sentence, then the trace
        import traceback

        traceback.print_exc()
        return 3, f"The exporter failed: {type(error).__name__}: {error}"
    return 0, None


if __name__ == "__main__":
    code, sentence = run(sys.argv)
    if sentence:
        print(f"MATCHA error {sentence}", file=sys.stderr)
    sys.stdout.flush()
    sys.stderr.flush()
    # Some builds of bpy hang or crash while Python shuts down; nothing is left to clean up.
    os._exit(code)
