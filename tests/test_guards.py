"""What the mutation run changes in a guard."""

import pytest

from tests.guards import NoGuard, definition, mutants

MODULE = """\
LIMITS = {"a": 1, "b": 2}


class Reader:
    size: int = Field(ge=3)

    def check(self, value):
        \"\"\"Check.\"\"\"
        if value > 3 and self.strict:
            raise ValueError(value)
        try:
            self.note(value)
        except OSError as error:
            return False
        with suppress(KeyError):
            pass
        return True
"""


@pytest.fixture
def root(tmp_path):
    (tmp_path / "package").mkdir()
    (tmp_path / "package" / "part.py").write_text(MODULE)
    return tmp_path


def changes(root, name):
    return {mutant.change: mutant.text for mutant in mutants(f"package.part:{name}", root)}


def test_each_mutant_changes_one_place_of_the_guard(root):
    found = changes(root, "Reader.check")
    assert {
        "raise ValueError(value) -> pass",
        "value > 3 and self.strict -> False",
        "value > 3 and self.strict -> True",
        "self.strict -> True",
        "OSError -> ()",
        "self.note(value) -> pass",
        "return False -> pass",
        "suppress(KeyError) -> __import__('contextlib').nullcontext()",
    } <= set(found)
    assert found["OSError -> ()"] == MODULE.replace("OSError", "()")
    assert all(compile(text, "part.py", "exec") and text != MODULE for text in found.values())
    kept = MODULE.partition("    def check")[0]
    assert all(text.startswith(kept) for text in found.values())


def test_what_usually_is_the_guard_comes_first(root):
    first = [mutant.change for mutant in mutants("package.part:Reader.check", root)][:3]
    assert set(first) == {
        "raise ValueError(value) -> pass", "value > 3 and self.strict -> False", "OSError -> ()"
    }  # fmt: skip


def test_constants_and_fields_are_guards(root):
    assert MODULE.replace('"a": 1,', "") in changes(root, "LIMITS").values()
    assert MODULE.replace("ge=3", "") in changes(root, "Reader.size").values()


@pytest.mark.parametrize("name", ["package.other:check", "package.part:check", "package.part:Reader.other"])
def test_a_guard_that_is_not_there_is_named(root, name):
    with pytest.raises(NoGuard, match=name):
        definition(name, root)
