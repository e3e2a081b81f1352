"""Of a figure, the panels and the lines in them."""


def line(axes, label):
    return next(found for found in axes.lines if found.get_label() == label)


def panel_axes(figure):
    return [axes for axes in figure.axes if axes.get_label() != "<colorbar>"]
