"""The demo's report: runs the experiments, measures the estimates, draws the figures, writes the page."""
