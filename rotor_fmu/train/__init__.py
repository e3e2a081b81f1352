"""The train: its data, its files, and what is wrong with them."""
