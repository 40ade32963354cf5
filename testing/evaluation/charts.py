# SPDX-License-Identifier: BSD-3-Clause
"""Bar and line charts as pictures."""
import os
import sys

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk
import vtkmodules.vtkRenderingContextOpenGL2  # noqa: F401 registers what draws charts
from vtkmodules.vtkChartsCore import vtkAxis, vtkChart, vtkChartXY
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkTable
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter
from vtkmodules.vtkViewsContext2D import vtkContextView

from ppfmeam import scripting

SIZE = (960, 540)
# Okabe and Ito's colours, which colour-blind people tell apart, and a few for more.
COLORS = ((0, 114, 178), (230, 159, 0), (0, 158, 115), (204, 121, 167), (86, 180, 233), (213, 94, 0), (240, 228, 66),
          (120, 120, 120),
          (0, 0, 0), (140, 80, 30), (170, 225, 170), (100, 30, 140))


def there_is_display():
    return bool(os.environ.get("DISPLAY"))


def tell_of_display():
    """Says on stderr why there are no charts, and how to get them."""
    if not there_is_display():
        print("no charts were made, there is no display: the same command after `xvfb-run -a` adds them to what is done",
              file=sys.stderr)


def bars(path, title, groups, series, unit):
    """Writes a PNG with a bar for each group and series; NaN has none. Nothing without a display."""
    chart = chart_of(title, "", unit)
    table = table_of(numpy.arange(len(groups), dtype=float), series)
    for column, name in enumerate(series, 1):
        add(chart, vtkChart.BAR, table, column, name)
    ticks, labels = vtkDoubleArray(), vtkStringArray()
    for place, group in enumerate(groups):
        ticks.InsertNextValue(place)
        labels.InsertNextValue(str(group))
    chart.GetAxis(vtkAxis.BOTTOM).SetCustomTickPositions(ticks, labels)
    save(chart, series, path)


def lines(path, title, x, series, across, unit):
    """Writes a PNG with a line over `x` for each of the series. Nothing without a display."""
    chart = chart_of(title, across, unit)
    table = table_of(numpy.asarray(x, dtype=float), series)
    for column, name in enumerate(series, 1):
        plot = add(chart, vtkChart.LINE, table, column, name)
        plot.SetWidth(2)
        plot.SetMarkerStyle(4)
    save(chart, series, path)


def chart_of(title, across, up):
    chart = vtkChartXY()
    chart.SetTitle(title)
    chart.SetShowLegend(True)
    chart.GetLegend().SetInline(False)
    for axis, text in ((vtkAxis.BOTTOM, across), (vtkAxis.LEFT, up)):
        chart.GetAxis(axis).SetTitle(text)
    return chart


def table_of(x, series):
    table = vtkTable()
    for name, values in (("", x), *series.items()):
        column = numpy_to_vtk(numpy.nan_to_num(numpy.asarray(values, dtype=float)), deep=True)
        column.SetName(name)
        table.AddColumn(column)
    return table


def add(chart, kind, table, column, name):
    plot = chart.AddPlot(kind)
    plot.SetInputData(table, 0, column)
    plot.SetLabel(name)
    plot.SetColor(*COLORS[(column - 1) % len(COLORS)], 255)
    return plot


def save(chart, series, path):
    if not there_is_display():
        return
    highest = numpy.nanmax(numpy.array([1e-9, *(value for values in series.values() for value in values)], float))
    chart.GetAxis(vtkAxis.LEFT).SetBehavior(vtkAxis.FIXED)
    chart.GetAxis(vtkAxis.LEFT).SetRange(0, 1.05 * highest)
    view = vtkContextView()
    view.GetRenderer().SetBackground(1, 1, 1)
    view.GetRenderWindow().SetOffScreenRendering(True)
    view.GetRenderWindow().SetSize(*SIZE)
    view.GetRenderWindow().SetMultiSamples(4)
    view.GetScene().AddItem(chart)
    view.GetRenderWindow().Render()
    shot = vtkWindowToImageFilter()
    shot.SetInput(view.GetRenderWindow())
    writer = vtkPNGWriter()
    writer.SetInputConnection(shot.GetOutputPort())
    scripting.write_by(writer, path)
