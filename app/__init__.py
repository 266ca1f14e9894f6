"""Composition root: settings, runtime, HTTP service, command line, web page."""
