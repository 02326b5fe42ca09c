-- Neovim 0.11 or newer: put this file into ~/.config/nvim/lua and write require('gable') into init.lua.
vim.filetype.add({ extension = {
  cga = 'cga', gbbg = 'gbbg', park = 'park', grammar = 'progen3d', pg3d = 'progen3d' } })
vim.lsp.config('gable', {
  cmd = { 'gable', 'lsp' },
  filetypes = { 'cga', 'gbbg', 'park', 'progen3d' },
  root_markers = { 'rules', 'assets', '.git' },
})
vim.lsp.enable('gable')
