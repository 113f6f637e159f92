class RecordingError(Exception):
    """A recording, result or file that cannot be used; the message names what is missing."""
