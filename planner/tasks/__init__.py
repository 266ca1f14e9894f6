"""The record of each request, and the queue that they wait in."""
