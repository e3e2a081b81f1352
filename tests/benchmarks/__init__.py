"""Speed and accuracy, measured side by side; see the README of this folder."""
