"""How far a published table is from what is proved: its errors between guaranteed bounds."""
