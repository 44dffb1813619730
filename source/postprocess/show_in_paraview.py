# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Shows the fields of this run in ParaView: the body, deformed so that one sees it,
coloured by the stress, over the last period. In the output directory:

    paraview --script=show_in_paraview.py
    pvpython --force-offscreen-rendering show_in_paraview.py PICTURE.png

(without a display after xvfb-run -a). The picture is of the instant with the largest stress. Stresses beyond the limit
below, as at the tip of a crack, have the last colour. What follows may be changed."""

import os
import sys

from paraview import simple

COLOUR_BY, COLOURS = "von_mises_stress", "Viridis (matplotlib)"
# COLOUR_BY, COLOURS = "principal_stress_1", "Cool to Warm"
LARGEST_DISPLACEMENT = 0.05  # as shown, of the longest side of the body
LIMIT = 5.  # of the colours, in mean stresses of von Mises


def solution():
    """Beside this file, or in the working directory, where paraview --script does not
    tell which file this is."""
    here = os.path.dirname(os.path.abspath(globals().get("__file__", "./x")))
    path = os.path.join(here, "solution.pvd")
    if not os.path.isfile(path):
        raise RuntimeError(f"{path}: there is no such file. Start ParaView in the output "
                           "directory of the run.")
    return path


def survey(reader):
    """Over all instants: the longest side of the body, the largest displacement,
    the range of the colours, and the instant at which they are farthest from 0."""
    displacement, values = 0., {}
    integral = simple.IntegrateVariables(Input=reader)
    mean = 0.
    for t in reader.TimestepValues:
        reader.UpdatePipeline(t)
        displacement = max(displacement,
                           reader.PointData["displacement"].GetRange(-1)[1])
        values[t] = reader.PointData[COLOUR_BY].GetRange()
        integral.UpdatePipeline(t)
        measure = next(integral.CellData[name].GetRange()[0]
                       for name in ("Volume", "Area") if name in integral.CellData.keys())
        mean = max(mean, integral.PointData["von_mises_stress"].GetRange()[0] / measure)
    ranges = list(values.values())
    limit = LIMIT * mean
    colours = (max(-limit, min(0., *(low for low, _ in ranges))),
               min(limit, max(high for _, high in ranges)))
    bounds = reader.GetDataInformation().GetBounds()
    size = max(high - low for low, high in zip(bounds[::2], bounds[1::2]))
    return size, displacement, colours, max(
        values, key=lambda t: max(map(abs, values[t])))


def magnification(size, displacement):
    """1, 2 or 5 times a power of ten, so that the displacement is as large as
    LARGEST_DISPLACEMENT or somewhat less."""
    if not displacement > 0.:
        return 1.
    wanted = LARGEST_DISPLACEMENT * size / displacement
    return max(factor for factor in (float(f"{digit}e{power}") for digit in (1, 2, 5)
                                     for power in range(-30, 31)) if factor <= wanted)


def main():
    reader = simple.PVDReader(FileName=solution())
    size, displacement, (low, high), worst = survey(reader)
    factor = magnification(size, displacement)
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.AnimationTime = worst
    view = simple.GetActiveViewOrCreate("RenderView")
    view.ViewTime = worst

    at_rest = simple.Show(reader, view)
    at_rest.Representation = "Feature Edges"
    at_rest.ColorArrayName = ["POINTS", ""]
    at_rest.AmbientColor = at_rest.DiffuseColor = [0.6, 0.6, 0.6]
    body = simple.WarpByVector(Input=reader, Vectors=["POINTS", "displacement"],
                               ScaleFactor=factor)
    shown = simple.Show(body, view)
    simple.ColorBy(shown, ("POINTS", COLOUR_BY))
    colours = simple.GetColorTransferFunction(COLOUR_BY)
    colours.ApplyPreset(COLOURS, True)
    if "Cool" in COLOURS:  # white is 0
        high = max(-low, high)
        low = -high
    colours.RescaleTransferFunction(low, high)
    shown.SetScalarBarVisibility(view, True)
    bar = simple.GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle = COLOUR_BY.replace("_", " "), ""
    bar.TitleColor = bar.LabelColor = [0., 0., 0.]
    bar.TitleFontSize, bar.LabelFontSize = 10, 10
    bar.LabelFormat = bar.RangeLabelFormat = "%-#6.3g"
    bar.WindowLocation, bar.Position = "Any Location", [0.85, 0.25]
    bar.ScalarBarLength = 0.5
    time = simple.Show(simple.AnnotateTimeFilter(
        Input=body, Format=f"t = {{time:g}}, displacements x {factor:g}"), view)
    time.Color, time.FontSize = [0., 0., 0.], 10

    view.UseColorPaletteForBackground = 0
    view.Background = [1., 1., 1.]
    view.OrientationAxesLabelColor = [0., 0., 0.]
    bounds = body.GetDataInformation().GetBounds()
    view.InteractionMode = "2D" if bounds[4] == bounds[5] else "3D"
    view.ResetCamera()
    camera = view.GetActiveCamera()
    if view.InteractionMode == "3D":
        camera.Elevation(20)
        camera.Azimuth(30)
        view.ResetCamera()
    camera.Zoom(0.9)
    simple.SetActiveSource(body)
    simple.Render(view)
    words = getattr(sys, "argv", [])
    if len(words) > 1 and words[-1].endswith(".png"):
        simple.SaveScreenshot(words[-1], view, ImageResolution=[1200, 900])


main()
