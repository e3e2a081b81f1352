"""Properties that hold for whatever hypothesis draws; see ``conftest.py`` for how much it draws."""
