"""The report on one run: reading what it left, drawing, and the page."""
