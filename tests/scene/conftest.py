"""Reads scenes from text."""

import pytest

from signorini.exceptions import SignoriniError
from signorini.scene.read import load_scene


@pytest.fixture
def load(tmp_path):
    """Reads a scene from text; any error must be one line that starts with the file's name."""

    def read(text, reader=load_scene):
        path = tmp_path / "scene.yaml"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        try:
            return reader(path)
        except SignoriniError as error:
            message = str(error)
            assert message.startswith(f"{path}: ")
            assert "\n" not in message
            raise type(error)(message.removeprefix(f"{path}: ")) from None

    return read
