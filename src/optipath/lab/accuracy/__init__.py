"""Accuracy: 50-digit references, the regions where methods fail, errors, tables, the chart."""
