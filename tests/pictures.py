"""What is in a picture: its texts, and which of them lie over one another or are cut."""

from itertools import combinations

from matplotlib.text import Text


def texts_of(figure):
    """The texts of a figure that are drawn; of axes, those of the ticks that are seen."""
    figure.draw_without_rendering()
    unseen = set()
    for ax in figure.axes:
        axes = (ax.xaxis, ax.yaxis)
        unseen |= {text for axis in axes for text in axis.findobj(Text)}
        if ax.axison:
            axes = [axis for axis in axes if axis.get_visible()]
            ticks = [tick for axis in axes for tick in axis._update_ticks()]
            unseen -= {text for tick in ticks for text in (tick.label1, tick.label2)}
            unseen -= {axis.label for axis in axes}
    drawn = {*figure.findobj(Text)} - unseen
    return [text for text in drawn if text.get_visible() and text.get_text()]


def faults_of(figure, texts=None):
    """The pairs of texts that overlap, and the texts that leave the figure; drawn if not given."""
    texts = texts_of(figure) if texts is None else texts
    boxes = [(text.get_text(), text.get_window_extent()) for text in texts]
    pairs = combinations(boxes, 2)
    faults = [(one, other) for (one, a), (other, b) in pairs if a.padded(-1).overlaps(b.padded(-1))]
    whole = figure.bbox.padded(1)
    return faults + [
        text
        for text, box in boxes
        if not (whole.contains(box.x0, box.y0) and whole.contains(box.x1, box.y1))
    ]
