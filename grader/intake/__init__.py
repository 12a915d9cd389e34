"""Read submissions and class lists as learning systems export them."""
